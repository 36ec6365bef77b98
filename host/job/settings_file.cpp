#include "host/job/settings_file.hpp"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>

#include "core/error.hpp"
#include "core/text/wording.hpp"
#include "host/job/job_error.hpp"
#include "host/job/nearest.hpp"
#include "host/job/parse_toml.hpp"

namespace unicursal::host {
namespace {

/// Bytes. Settings are written by hand; a larger file was named by mistake.
constexpr std::uintmax_t largest_file = 1 << 20;
constexpr std::size_t most_listed_keys = 40;

std::string read_text(const std::filesystem::path& file) {
  std::error_code error;
  if (std::filesystem::is_directory(file, error)) {
    throw core::FileError(file.string(), "", "is a folder", "name a file in it");
  }
  if (!std::filesystem::is_regular_file(file, error)) {
    throw core::FileError(file.string(), "", "does not exist", "check the path");
  }
  if (std::filesystem::file_size(file, error) > largest_file) {
    throw core::FileError(file.string(), "", "is too big for a settings file",
                          "name a job or profile in TOML");
  }
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  if (!stream) throw core::FileError(file.string(), "", "cannot be read", "check its permissions");
  return text.str();
}

const char* kind_of(const toml::node& node) {
  if (node.is_table()) return "a table";
  if (node.is_array()) return "a list";
  if (node.is_string()) return "a text";
  if (node.is_boolean()) return "true or false";
  if (node.is_number()) return "a number";
  return "a date or time";
}

std::string joined(const std::vector<std::string>& words) {
  return fmt::format("\"{}\"", fmt::join(words, "\", \""));
}

}  // namespace

bool Range::holds(double value) const {
  return std::isfinite(value) && value <= high && (low_excluded ? value > low : value >= low);
}

std::string Range::words() const {
  const std::string suffix = *unit ? std::string(" ") + unit : "";
  if (std::isfinite(high)) {
    return low_excluded ? fmt::format("above {}, up to {}{}", low, high, suffix)
                        : fmt::format("from {} to {}{}", low, high, suffix);
  }
  return fmt::format("{} {}{}", low_excluded ? "above" : "at least", low, suffix);
}

Range above(double low, const char* unit) {
  return {low, std::numeric_limits<double>::infinity(), true, unit};
}
Range at_least(double low, const char* unit) {
  return {low, std::numeric_limits<double>::infinity(), false, unit};
}
Range between(double low, double high, const char* unit) {
  return {low, high, false, unit};
}

Section::Section(const std::filesystem::path& file, const toml::table& table, std::string name,
                 std::vector<std::string> known)
    : file_(file), table_(table), name_(std::move(name)) {
  for (auto&& [key, node] : table_) {
    if (known.empty() || std::find(known.begin(), known.end(), key.str()) != known.end()) continue;
    const std::string meant = meant_by(key.str(), known);
    fail(key.str(), "is not a known key here",
         meant.empty() ? "leave it out; the keys here are " + core::listed(known, most_listed_keys)
                       : fmt::format("did you mean \"{}\"?", meant));
  }
}

std::string Section::path(std::string_view key) const {
  return name_.empty() ? std::string(key) : fmt::format("{}.{}", name_, key);
}

std::size_t Section::line(std::string_view key) const {
  const toml::node* node = table_.get(key);
  // Keys of dotted or inline tables may lack a position; the table's is the next best.
  if (node && node->source().begin.line > 0) return node->source().begin.line;
  return std::max<std::size_t>(1, table_.source().begin.line);
}

void Section::fail(std::string_view key, const std::string& problem, const std::string& remedy) const {
  throw JobError(file_.string(), fmt::format("line {}", line(key)), fmt::format("{} {}", path(key), problem),
                 remedy);
}

const toml::node& Section::required(std::string_view key, std::string_view remedy) const {
  const toml::node* node = table_.get(key);
  if (!node) fail(key, "is missing", std::string(remedy));
  return *node;
}

double Section::checked(std::string_view key, const toml::node& node, const Range& range,
                        std::string_view remedy) const {
  if (!node.is_number())
    fail(key, fmt::format("is {} where a number is expected", kind_of(node)), std::string(remedy));
  const std::optional<double> value = node.value<double>();
  if (!value) fail(key, "has more digits than can be distinguished", std::string(remedy));
  if (!range.holds(*value)) {
    fail(key, fmt::format("is {}, but must be {}", *value, range.words()), std::string(remedy));
  }
  return *value;
}

double Section::number(std::string_view key, const Range& range, std::string_view remedy) const {
  return checked(key, required(key, remedy), range, remedy);
}

double Section::number_or(std::string_view key, double otherwise, const Range& range,
                          std::string_view remedy) const {
  return has(key) ? number(key, range, remedy) : otherwise;
}

std::string Section::text(std::string_view key, std::string_view remedy) const {
  const toml::node& node = required(key, remedy);
  const std::optional<std::string> value = node.value<std::string>();
  if (!value) fail(key, fmt::format("is {} where a text is expected", kind_of(node)), std::string(remedy));
  return *value;
}

std::string Section::text_or(std::string_view key, std::string otherwise, std::string_view remedy) const {
  return has(key) ? text(key, remedy) : std::move(otherwise);
}

bool Section::flag_or(std::string_view key, bool otherwise, std::string_view remedy) const {
  if (!has(key)) return otherwise;
  const toml::node& node = *table_.get(key);
  if (!node.is_boolean()) {
    fail(key, fmt::format("is {} where true or false is expected", kind_of(node)), std::string(remedy));
  }
  return *node.value<bool>();
}

std::vector<double> Section::numbers(std::string_view key, const Range& range,
                                     std::string_view remedy) const {
  const toml::node& node = required(key, remedy);
  const toml::array* list = node.as_array();
  if (!list)
    fail(key, fmt::format("is {} where a list of numbers is expected", kind_of(node)), std::string(remedy));
  std::vector<double> values;
  for (const toml::node& item : *list) values.push_back(checked(key, item, range, remedy));
  return values;
}

Section Section::section(std::string_view key, std::vector<std::string> known,
                         std::string_view remedy) const {
  const toml::node& node = required(key, remedy);
  const toml::table* inner = node.as_table();
  if (!inner) fail(key, fmt::format("is {} where a table is expected", kind_of(node)), std::string(remedy));
  return {file_, *inner, path(key), std::move(known)};
}

Section Section::section_or_empty(std::string_view key, std::vector<std::string> known) const {
  static const toml::table empty;
  if (!has(key)) return {file_, empty, path(key), std::move(known)};
  return section(key, std::move(known), fmt::format("write [{}] and its keys below", key));
}

std::string Section::choice(std::string_view key, const toml::node& node,
                            const std::vector<std::string>& choices) const {
  const std::optional<std::string> value = node.value<std::string>();
  if (!value) fail(key, fmt::format("is {}", kind_of(node)), "choose one of " + joined(choices));
  if (std::find(choices.begin(), choices.end(), *value) == choices.end()) {
    const std::string meant = meant_by(*value, choices);
    fail(key, fmt::format("is \"{}\", which is none of {}", *value, joined(choices)),
         meant.empty() ? "choose one of these" : fmt::format("did you mean \"{}\"?", meant));
  }
  return *value;
}

SettingsFile::SettingsFile(std::filesystem::path file)
    : file_(std::move(file)), table_(parse_toml(read_text(file_), file_)) {}

SettingsFile::SettingsFile(std::filesystem::path file, const std::string& text)
    : file_(std::move(file)), table_(parse_toml(text, file_)) {}

Section SettingsFile::root(std::vector<std::string> known) const {
  return {file_, table_, "", std::move(known)};
}

}  // namespace unicursal::host
