#include "host/daemon/preferences.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "host/daemon/api_body.hpp"
#include "host/daemon/camera.hpp"
#include "host/daemon/elsewhere.hpp"
#include "host/daemon/state_folder.hpp"
#include "host/engine/temperature_limits.hpp"

namespace unicursal::host {
namespace {

using nlohmann::json;

constexpr std::size_t longest_printer_name = 320, longest_preset_name = 160,
                      longest_language = 16;  ///< bytes

const std::vector<Preset> usual_presets{{"PLA", 210, 60}, {"PETG", 240, 80}};

json presets_json(const std::vector<Preset>& presets) {
  json all = json::array();
  for (const Preset& one : presets)
    all.push_back({{"name", one.name}, {"nozzle_c", one.nozzle_c}, {"bed_c", one.bed_c}});
  return all;
}

/// In UTF-8, since JSON is.
std::string checked_line(const json& text, const char* what, std::size_t longest) {
  if (!text.is_string()) throw HttpError(400, fmt::format("{} is not a text", what));
  auto line = text.get<std::string>();
  const bool plain = std::none_of(line.begin(), line.end(),
                                  [](char c) { return static_cast<unsigned char>(c) < ' ' || c == '\x7f'; });
  if (line.size() > longest || !plain)
    throw HttpError(422, "out_of_range",
                    fmt::format("{} is one line of at most {} bytes; choose a shorter one", what, longest));
  return line;
}

double checked_heat(const json& preset, const char* key, double hottest) {
  const auto found = preset.find(key);
  if (found == preset.end() || !found->is_number())
    throw HttpError(400, fmt::format("{} of a preset is a number of °C", key));
  const double value = found->get<double>();
  if (!(value >= 0 && value <= hottest))
    throw HttpError(422, "out_of_range", fmt::format("{} of a preset is 0 to {} °C", key, hottest));
  return value;
}

std::vector<Preset> checked_presets(const json& presets) {
  if (!presets.is_array()) throw HttpError(400, "presets is a list");
  if (presets.size() > Preferences::most_presets)
    throw HttpError(422, "out_of_range",
                    fmt::format("there are {} presets at most; leave some out", Preferences::most_presets));
  std::vector<Preset> all;
  for (const json& one : presets) {
    if (!one.is_object()) throw HttpError(400, "a preset is an object with name, nozzle_c and bed_c");
    Preset preset;
    preset.name = checked_line(one.value("name", json()), "the name of a preset", longest_preset_name);
    if (preset.name.empty())
      throw HttpError(422, "out_of_range", "a preset has no name; name it for example PLA");
    preset.nozzle_c = checked_heat(one, "nozzle_c", hottest_nozzle);
    preset.bed_c = checked_heat(one, "bed_c", hottest_bed);
    all.push_back(std::move(preset));
  }
  return all;
}

std::string checked_language(const json& text) {
  std::string language = checked_line(text, "the language", longest_language);
  const bool plain = std::all_of(language.begin(), language.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-';
  });
  if (!plain) throw HttpError(422, "out_of_range", "the language is a code such as \"de\"");
  return language;
}

std::string without_query(const std::string& address) {
  return address.substr(0, address.find('?'));
}

void put_into(const json& body, PreferenceValues& values) {
  for (const auto& [key, value] : body.items()) {
    if (key == "name") values.name = checked_line(value, "the printer's name", longest_printer_name);
    if (key == "language") values.language = checked_language(value);
    if (key == "presets") values.presets = checked_presets(value);
    if (key == "camera") {
      values.camera = checked_line(value, "the camera's address", longest_camera_address);
      if (!values.camera.empty()) parse_camera_address(values.camera);
    }
  }
}

json all_of(const PreferenceValues& values) {
  return {{"name", values.name},
          {"language", values.language},
          {"camera", values.camera},
          {"presets", presets_json(values.presets)}};
}

}  // namespace

Preferences::Preferences(std::filesystem::path file)
    : file_(std::move(file)), disk_(std::make_unique<asio::thread_pool>(1)) {
  values_.presets = usual_presets;
  std::ifstream stream(file_);
  if (!stream) return;
  try {
    put_into(json::parse(stream), values_);
  } catch (const std::exception&) {
    throw DaemonError(file_.string(), "", "does not hold preferences of this program",
                      "move it away; the usual ones are taken then");
  }
}

Preferences::~Preferences() {
  disk_->join();
}

json Preferences::shown_to(Right right) const {
  json shown = all_of(values_);
  if (right < Right::all) shown["camera"] = without_query(values_.camera);
  return shown;
}

asio::awaitable<void> Preferences::change(json body, Right right) {
  PreferenceValues changed = values_;
  put_into(body, changed);
  if (changed.camera != values_.camera && right < Right::all) {
    // A page sends back what it was shown.
    if (changed.camera != without_query(values_.camera))
      throw HttpError(
          403, "only the token, not a key, may set the camera's address: the daemon asks it for pictures");
    changed.camera = values_.camera;
  }
  json kept = all_of(changed);
  kept["version"] = 1;
  const PreferenceValues before = std::exchange(values_, std::move(changed));
  const std::uint64_t change = ++changes_;
  const auto write_all = [file = file_,
                          text = kept.dump(1, ' ', false, json::error_handler_t::replace) + "\n"] {
    write_state(file, text);
    return true;
  };
  std::string full;
  try {
    co_await elsewhere(*disk_, write_all);
  } catch (const DaemonError& error) {
    full = error.what();
  }
  if (full.empty()) co_return;
  if (change == changes_) values_ = before;
  throw Refused(Refused::Why::no_room, full);
}

}  // namespace unicursal::host
