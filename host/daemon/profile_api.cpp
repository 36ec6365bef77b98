// The requests that concern the printer's profile, its ports, and what doctor finds.
#include <fmt/format.h>

#include <charconv>

#include "host/daemon/api.hpp"
#include "host/daemon/api_body.hpp"
#include "host/doctor/findings.hpp"
#include "host/job/frames.hpp"
#include "host/job/job_error.hpp"
#include "host/job/profile_draft.hpp"
#include "host/job/profile_values.hpp"

namespace unicursal::host {
namespace {

using nlohmann::json;

const char* grade_of(Finding::Weight weight) {
  switch (weight) {
    case Finding::Weight::good:
      return "good";
    case Finding::Weight::note:
    case Finding::Weight::warning:
      return "doubtful";
    case Finding::Weight::trouble:
      break;
  }
  return "bad";
}

/// The remedy stands behind the last semicolon.
json as_json(const Finding& finding) {
  json one = {{"grade", grade_of(finding.weight)}, {"sentence", finding.text}};
  const std::size_t at = finding.text.rfind("; ");
  if (finding.weight == Finding::Weight::good || at == std::string::npos) return one;
  one["sentence"] = finding.text.substr(0, at);
  one["remedy"] = finding.text.substr(at + 2);
  return one;
}

/// A mistake in a profile, at its key and line.
Response mistake_in(const JobError& error) {
  json body = {{"error", error.problem() + "; " + error.remedy()}, {"code", "bad_job"}};
  const std::string& place = error.place();
  std::size_t line = 0;
  constexpr std::string_view line_word = "line ";
  if (place.starts_with(line_word))
    std::from_chars(place.data() + line_word.size(), place.data() + place.size(), line);
  if (line > 0) body["line"] = line;
  const std::string key = line > 0 ? error.problem().substr(0, error.problem().find(' ')) : place;
  if (key.find('.') != std::string::npos) body["key"] = key;
  return reply(std::move(body), 422);
}

/// [[filament]] for each feeder; empty if nothing is said.
std::string filament_tables(const json& body) {
  const auto found = body.find("filaments");
  if (found == body.end()) return {};
  if (!found->is_array()) throw HttpError(400, "filaments is a list");
  std::string text;
  for (const json& one : *found) {
    if (!one.is_object()) throw HttpError(400, "a filament is {\"name\", \"material\", \"colour\"}");
    text += "\n[[filament]]\n";
    for (const char* key : {"name", "material", "colour"}) {
      if (const std::string value = text_in(one, key); !value.empty())
        text += fmt::format("{} = {}\n", key, toml_text(value));
    }
  }
  return text;
}

}  // namespace

asio::awaitable<Response> Api::list_ports(Request) {
  const json printer = daemon_.printer();
  json ports = json::array();
  const std::vector<PortInfo> found = co_await daemon_.ports();
  for (const PortInfo& port : found) {
    json one = {{"path", port.path},
                {"stable_path", port.stable_path},
                {"description", port.description},
                {"usb", port.usb}};
    const std::string used = printer.value("port", "");
    const bool same = used == port.path || (!used.empty() && used == port.stable_path);
    one["firmware"] = same ? printer.value("firmware", "") : "";
    ports.push_back(std::move(one));
  }
  co_return reply({{"ports", ports}});
}

asio::awaitable<Response> Api::examine(Request request) {
  const json body = read_object(request, {"port"});
  const FoundPrinter found = co_await daemon_.examine_printer(text_in(body, "port"));
  json list = json::array();
  for (const Finding& finding : findings(found.examination, found.baud, daemon_.whole_profile()))
    list.push_back(as_json(finding));
  json answer = {{"findings", list}, {"port", found.port}, {"baud", found.baud}};
  const gcode::Identity& who = found.examination.identity;
  answer["firmware"] = who.firmware;
  if (const ShippedFrame* frame = frame_of_machine(who.machine)) answer["frame"] = frame->name;
  co_return reply(std::move(answer));
}

asio::awaitable<Response> Api::show_profile(Request) {
  const Daemon::ProfileAsText profile = co_await daemon_.profile_text();
  co_return reply({{"file", profile.file.string()},
                   {"toml", profile.text},
                   {"keys", profile_form(profile.text, profile.file)}});
}

/// The whole text, or some values, which leave everything else as it is.
asio::awaitable<Response> Api::change_profile(Request request) {
  const json body = read_object(request, {"toml", "values"});
  const json values = body.value("values", json());
  if (body.contains("toml") == body.contains("values")) throw HttpError(400, "send toml, or values");
  if (body.contains("values") && !values.is_object())
    throw HttpError(400, "values is an object such as {\"printer.nozzle\": 0.6}");
  const Daemon::ProfileAsText before = co_await daemon_.profile_text();
  std::optional<Response> mistake;
  try {
    std::string text =
        body.contains("toml") ? text_in(body, "toml") : with_values(before.text, values, before.file);
    co_await daemon_.keep_profile(before.file, std::move(text));
  } catch (const JobError& error) {
    mistake = mistake_in(error);
  }
  if (mistake) co_return std::move(*mistake);
  co_return reply({{"saved", true}});
}

asio::awaitable<Response> Api::list_frames(Request) {
  json list = json::array();
  for (const ShippedFrame& frame : frames()) {
    const Profile profile = profile_in(std::string(frame.text), std::filesystem::path(frame.name));
    const auto& bed = profile.printer.bed;
    list.push_back({{"name", frame.name},
                    {"title", fmt::format("{}, {} feeders, {:g} × {:g} × {:g} mm", profile.printer.name,
                                          profile.printer.feeders, bed[0], bed[1], bed[2])}});
  }
  co_return reply({{"frames", list}});
}

/// From a shipped frame, and what the printer at the port reports if one is named.
asio::awaitable<Response> Api::make_profile(Request request) {
  const json body = read_object(request, {"frame", "name", "port", "filaments", "replace"});
  const ShippedFrame* frame = frame_named(text_in(body, "frame"));
  if (!frame) throw HttpError(404, "no shipped profile has that name");
  const std::filesystem::path file = daemon_.new_profile_file(yes(body, "replace"));
  ProfileDraft draft{std::string(frame->text)};
  if (const std::string name = text_in(body, "name"); !name.empty())
    draft.set("printer", "name", toml_text(name));
  const std::string filaments = filament_tables(body), port = text_in(body, "port");
  std::optional<Response> mistake;
  try {
    if (!port.empty() && port != "none") {
      const FoundPrinter found = co_await daemon_.examine_printer(port);
      note_reported(draft, found, profile_in(draft.text(), file).printer);
    }
    co_await daemon_.keep_profile(file, draft.text() + filaments);
  } catch (const JobError& error) {
    mistake = mistake_in(error);
  }
  if (mistake) co_return std::move(*mistake);
  co_return reply({{"file", file.string()}}, 201);
}

}  // namespace unicursal::host
