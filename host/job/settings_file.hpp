// Reads settings from TOML; every mistake is reported with file, line, key and remedy.
// This header pulls in toml++; only the files of host/job that parse include it.
//
//   const SettingsFile file("job.toml");
//   const Section root = file.root({"part", "mixture"});
//   const Section part = root.section("part", {"height", "layer_height"}, "write [part]");
//   const double height = part.number("height", above(0, "mm"), "write for example height = 1.0");
#pragma once

#include <toml++/toml.h>
#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace unicursal::host {

/// The allowed range of a number, with its unit for messages.
struct Range {
  double low;
  double high;
  bool low_excluded;
  const char* unit;

  bool holds(double value) const;
  /// "above 0 mm", "above 0, up to 10000 mm", "from 0 to 0.33", "at least 1"
  std::string words() const;
};

Range above(double low, const char* unit);
Range at_least(double low, const char* unit);
Range between(double low, double high, const char* unit);

/// A table of a settings file. The constructor refuses unknown keys.
class Section {
 public:
  Section(const std::filesystem::path& file, const toml::table& table, std::string name,
          std::vector<std::string> known);

  bool has(std::string_view key) const { return table_.contains(key); }
  const toml::node* find(std::string_view key) const { return table_.get(key); }
  const toml::table& table() const { return table_; }

  /// The required forms throw JobError if the key is missing; all throw if its type or range is wrong.
  /// `remedy` ends the sentence, for example "write layer_height = 0.2".
  double number(std::string_view key, const Range& range, std::string_view remedy) const;
  double number_or(std::string_view key, double otherwise, const Range& range, std::string_view remedy) const;
  std::string text(std::string_view key, std::string_view remedy) const;
  std::string text_or(std::string_view key, std::string otherwise, std::string_view remedy) const;
  bool flag_or(std::string_view key, bool otherwise, std::string_view remedy) const;
  std::vector<double> numbers(std::string_view key, const Range& range, std::string_view remedy) const;
  template <std::size_t n>
  std::array<double, n> numbers_or(std::string_view key, std::array<double, n> otherwise, const Range& range,
                                   std::string_view remedy) const;

  /// A sub-table. If it is missing, the first form throws and the second returns an empty one.
  Section section(std::string_view key, std::vector<std::string> known, std::string_view remedy) const;
  Section section_or_empty(std::string_view key, std::vector<std::string> known) const;

  /// One of `choices`, else an error that names the nearest.
  std::string choice(std::string_view key, const toml::node& node,
                     const std::vector<std::string>& choices) const;

  [[noreturn]] void fail(std::string_view key, const std::string& problem, const std::string& remedy) const;
  /// "part.bead_width"
  std::string path(std::string_view key) const;
  const std::filesystem::path& file() const { return file_; }

 private:
  const toml::node& required(std::string_view key, std::string_view remedy) const;
  double checked(std::string_view key, const toml::node& node, const Range& range,
                 std::string_view remedy) const;
  std::size_t line(std::string_view key) const;

  const std::filesystem::path& file_;
  const toml::table& table_;
  std::string name_;
};

/// A parsed file; sections refer to it and must not outlive it.
class SettingsFile {
 public:
  /// Throws core::FileError if it cannot be read, JobError if it is not TOML.
  explicit SettingsFile(std::filesystem::path file);
  /// Settings that are not in a file; `file` is for messages, and relative names start from its folder.
  SettingsFile(std::filesystem::path file, const std::string& text);

  Section root(std::vector<std::string> known) const;

 private:
  std::filesystem::path file_;
  toml::table table_;
};

template <std::size_t n>
std::array<double, n> Section::numbers_or(std::string_view key, std::array<double, n> otherwise,
                                          const Range& range, std::string_view remedy) const {
  if (!has(key)) return otherwise;
  const std::vector<double> values = numbers(key, range, remedy);
  if (values.size() != n) {
    fail(key, "has " + std::to_string(values.size()) + " numbers instead of " + std::to_string(n),
         std::string(remedy));
  }
  std::copy(values.begin(), values.end(), otherwise.begin());
  return otherwise;
}

}  // namespace unicursal::host
