#include "host/job/profile_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "host/job/job_error.hpp"
#include "host/job/parse_toml.hpp"
#include "host/job/profile.hpp"
#include "host/job/profile_draft.hpp"
#include "host/job/profile_edit.hpp"
#include "host/job/profile_keys.hpp"

namespace unicursal::host {
namespace {

using nlohmann::json;

json as_json(const toml::node& node) {
  if (const auto* text = node.as_string()) return text->get();
  if (const auto* flag = node.as_boolean()) return flag->get();
  if (const auto* whole = node.as_integer()) return whole->get();
  if (const auto* number = node.as_floating_point()) return number->get();
  json list = json::array();
  if (const toml::array* array = node.as_array()) {
    for (const toml::node& one : *array) list.push_back(as_json(one));
    return list;
  }
  return {};
}

void add_key(json& form, const ProfileKey& key, const std::string& name, const toml::table* table,
             std::string_view short_name) {
  json one = {{"key", name}, {"unit", key.unit}, {"takes", key.takes}, {"help", key.help}};
  if (const toml::node* node = table ? table->get(short_name) : nullptr) one["value"] = as_json(*node);
  form.push_back(std::move(one));
}

std::string as_toml(const json& value, const std::string& key, const std::filesystem::path& file) {
  const auto refuse = [&] {
    throw JobError(file.string(), key, "has a value that a profile cannot hold",
                   "send a text, a number, true, false, or a list of them");
  };
  if (value.is_string()) return toml_text(value.get<std::string>());
  if (value.is_boolean()) return value.get<bool>() ? "true" : "false";
  if (value.is_number_integer()) return value.dump();
  if (value.is_number()) {
    std::string text = fmt::format("{:.10g}", value.get<double>());
    return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
  }
  if (!value.is_array()) refuse();
  std::string list;
  for (const json& one : value) list += (list.empty() ? "" : ", ") + as_toml(one, key, file);
  return "[" + list + "]";
}

/// "filament.2.name", "printer.nozzle"
ProfileChange change_of(const std::string& key, std::string value, const std::filesystem::path& file) {
  const std::size_t first = key.find('.'), last = key.rfind('.');
  if (first == std::string::npos)
    throw JobError(file.string(), key.substr(0, 40), "is not a key of a profile", "see unicursal-profile(5)");
  ProfileChange change{key.substr(0, first), {}, key.substr(last + 1), std::move(value), {}};
  const std::string plain = change.table + "." + change.key;
  const std::vector<ProfileKey>& keys = profile_keys();
  const bool known =
      std::any_of(keys.begin(), keys.end(), [&](const ProfileKey& one) { return one.key == plain; });
  if (first != last) {
    std::size_t number = 0;
    const char* end = key.data() + last;
    const auto [stop, error] = std::from_chars(key.data() + first + 1, end, number);
    if (error == std::errc() && stop == end && number > 0) change.index = number - 1;
  }
  if (!known || change.index.has_value() != (change.table == "filament"))
    throw JobError(file.string(), key.substr(0, 40), "is not a key of a profile", "see unicursal-profile(5)");
  return change;
}

}  // namespace

json profile_form(const std::string& text, const std::filesystem::path& file) {
  const toml::table root = parse_toml(text, file);
  json form = json::array();
  const toml::array* filaments = root["filament"].as_array();
  for (const ProfileKey& key : profile_keys()) {
    const std::size_t dot = key.key.find('.');
    const std::string table = key.key.substr(0, dot), name = key.key.substr(dot + 1);
    if (table != "filament") add_key(form, key, key.key, root[table].as_table(), name);
  }
  for (std::size_t feeder = 0; filaments && feeder < filaments->size(); ++feeder) {
    for (const ProfileKey& key : profile_keys()) {
      if (!key.key.starts_with("filament.")) continue;
      const std::string name = key.key.substr(key.key.find('.') + 1);
      add_key(form, key, fmt::format("filament.{}.{}", feeder + 1, name), filaments->get(feeder)->as_table(),
              name);
    }
  }
  return form;
}

std::string with_values(const std::string& text, const json& values, const std::filesystem::path& file) {
  std::vector<ProfileChange> changes;
  for (const auto& [key, value] : values.items())
    changes.push_back(change_of(key, as_toml(value, key, file), file));
  const std::string changed = changes.empty() ? text : with_changes(text, changes, file);
  profile_in(changed, file);
  return changed;
}

}  // namespace unicursal::host
