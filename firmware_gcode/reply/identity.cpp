#include "firmware_gcode/reply/identity.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>

#include "core/text/printable.hpp"
#include "firmware_gcode/reply/reply.hpp"

namespace unicursal::gcode {
namespace {

constexpr std::size_t longest_answer = 1000;  ///< characters; the longest known are half of that
constexpr std::size_t shortest_key = 3;       ///< letters; excludes times and drives

bool is_key(std::string_view text) {
  const auto fits = [](char c) { return (c >= 'A' && c <= 'Z') || c == '_'; };
  return text.size() >= shortest_key && std::all_of(text.begin(), text.end(), fits);
}

/// Splits "A:one two B:three" by key; values may contain spaces and colons.
std::map<std::string, std::string> fields_of(std::string_view text) {
  std::map<std::string, std::string> fields;
  std::string* value = nullptr;
  while (!text.empty()) {
    const std::string_view word = text.substr(0, text.find(' '));
    text.remove_prefix(std::min(word.size() + 1, text.size()));
    const auto colon = word.find(':');
    if (colon != std::string_view::npos && is_key(word.substr(0, colon))) {
      value = &fields[std::string(word.substr(0, colon))];
      *value = word.substr(colon + 1);
    } else if (value != nullptr) {
      value->append(value->empty() ? "" : " ").append(word);
    }
  }
  return fields;
}

std::optional<std::uint32_t> count_in(std::string_view& text) {
  std::uint32_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc()) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return value;
}

/// Finds the first number that contains a point.
std::optional<Version> version_in(std::string_view text) {
  while (!text.empty()) {
    const auto digit = text.find_first_of("0123456789");
    if (digit == std::string_view::npos) return std::nullopt;
    text.remove_prefix(digit);
    std::array<std::uint32_t, 3> parts{};
    std::size_t known = 0;
    for (auto part = count_in(text); part; part = count_in(text)) {
      parts[known++] = *part;
      if (known == parts.size() || !text.starts_with('.')) break;
      text.remove_prefix(1);
    }
    if (known > 1) return Version{parts[0], parts[1], parts[2]};
    if (known == 0) text.remove_prefix(std::min(text.find_first_not_of("0123456789"), text.size()));
  }
  return std::nullopt;
}

constexpr std::array<std::pair<Family, std::string_view>, 5> names{
    {{Family::marlin, "Marlin"},
     {Family::repetier, "Repetier"},
     {Family::reprapfirmware, "RepRapFirmware"},
     {Family::klipper, "Klipper"},
     {Family::smoothieware, "Smoothieware"}}};

}  // namespace

std::string_view name(Family family) {
  for (const auto& [known, called] : names) {
    if (known == family) return called;
  }
  return "unknown";
}

bool Identity::can(const std::string& capability) const {
  const auto known = capabilities.find(capability);
  return known != capabilities.end() && known->second;
}

void Identity::learn(const std::string& capability, bool on) {
  if (capabilities.size() < most_capabilities || capabilities.contains(capability))
    capabilities[capability] = on;
}

Identity identify(std::string_view line) {
  auto fields = fields_of(core::printable(line, longest_answer));
  Identity identity;
  identity.firmware = fields["FIRMWARE_NAME"];
  identity.machine = fields["MACHINE_TYPE"];
  for (const auto& [family, called] : names) {
    if (identity.firmware.find(called) != std::string::npos) identity.family = family;
  }
  const std::string& apart = fields["FIRMWARE_VERSION"];
  identity.version = version_in(apart.empty() ? identity.firmware : apart);
  std::string_view extruders = fields["EXTRUDER_COUNT"];
  identity.extruders = count_in(extruders);
  return identity;
}

}  // namespace unicursal::gcode
