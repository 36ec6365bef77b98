#include "firmware_gcode/toolpath/placeholders.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>
#include <utility>

#include "core/error.hpp"
#include "firmware_gcode/dialect/number.hpp"
#include "firmware_gcode/print/heat_targets.hpp"

namespace unicursal::gcode {
namespace {

using Value = std::function<double(const Printer&, const PrintSettings&)>;
constexpr int decimals = 3;

const std::map<std::string, Value>& values() {
  using P = const Printer&;
  using S = const PrintSettings&;
  static const std::map<std::string, Value> all = {
      {"nozzle_temperature", [](P p, S s) { return first_temperatures(p, s).nozzle; }},
      {"bed_temperature", [](P p, S s) { return first_temperatures(p, s).bed; }},
      {"layer_count", [](P, S s) { return static_cast<double>(s.layer_count); }},
      {"layer_height", [](P, S s) { return s.layer_height; }},
      {"first_layer_height", [](P, S s) { return s.first_layer_height; }},
      {"part_height", [](P, S s) { return s.part_height; }},
      {"part_left", [](P, S s) { return s.extent.min.x(); }},
      {"part_right", [](P, S s) { return s.extent.max.x(); }},
      {"part_front", [](P, S s) { return s.extent.min.y(); }},
      {"part_back", [](P, S s) { return s.extent.max.y(); }},
      {"bed_x", [](P p, S) { return p.bed[0]; }},
      {"bed_y", [](P p, S) { return p.bed[1]; }},
      {"bed_z", [](P p, S) { return p.bed[2]; }},
      {"nozzle", [](P p, S) { return p.nozzle; }},
      {"filament_diameter", [](P p, S) { return p.filament_diameter; }},
      {"retraction_length", [](P p, S) { return p.retraction_length; }},
  };
  return all;
}

/// Calls `text(piece)` and `name(word)` for what stands outside and between braces. Comments are left alone.
template <class Text, class Name>
bool take_apart(std::string_view from, const Text& text, const Name& name) {
  while (!from.empty()) {
    const std::size_t open = from.find_first_of("{};");
    text(from.substr(0, open));
    if (open == std::string_view::npos) return true;
    from.remove_prefix(open);
    if (from.front() == '}') return false;
    if (from.front() == ';') {
      const std::size_t end = std::min(from.find('\n'), from.size());
      text(from.substr(0, end));
      from.remove_prefix(end);
      continue;
    }
    const std::size_t close = from.find_first_of("}\n");
    if (close == std::string_view::npos || from[close] == '\n') return false;
    name(from.substr(1, close - 1));
    from.remove_prefix(close + 1);
  }
  return true;
}

}  // namespace

std::vector<std::string> placeholder_names() {
  std::vector<std::string> names;
  for (const auto& [name, value] : values()) names.push_back(name);
  return names;
}

std::vector<std::string> placeholders_in(std::string_view text) {
  std::vector<std::string> names;
  take_apart(
      text, [](std::string_view) {}, [&](std::string_view name) { names.emplace_back(name); });
  return names;
}

std::string with_values(const std::string& text, const std::string& key, const Printer& printer,
                        const PrintSettings& settings) {
  std::string result;
  const auto put = [&](std::string_view name) {
    const auto found = values().find(std::string(name));
    if (found == values().end()) {
      throw core::DataError("", key, fmt::format("{{{}}} stands for nothing", name),
                            fmt::format("there are {{{}}}", fmt::join(placeholder_names(), "}, {")));
    }
    result += short_number(found->second(printer, settings), decimals);
  };
  if (!take_apart(
          text, [&](std::string_view piece) { result += piece; }, put)) {
    throw core::DataError("", key, "a brace has no partner on its line",
                          "write a name in braces such as {layer_count}, or take the brace out");
  }
  return result;
}

}  // namespace unicursal::gcode
