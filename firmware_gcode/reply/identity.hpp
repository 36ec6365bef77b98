// The identity of a firmware: its answer to M115 as typed values.
//
//   FIRMWARE_NAME:Marlin 2.1.2 (Mar 1 2023 12:30:00) SOURCE_CODE_URL:… EXTRUDER_COUNT:1 UUID:…
//   Cap:AUTOREPORT_TEMP:1
//
// Marlin, Repetier, RepRapFirmware, Smoothieware and Klipper answer in this form; only newer ones add
// FIRMWARE_VERSION or Cap: lines. The text is hostile input like every reply: it is bounded and not trusted.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace unicursal::gcode {

enum class Family { unknown, marlin, repetier, reprapfirmware, klipper, smoothieware };

/// "Marlin", …; "unknown" for any other.
std::string_view name(Family family);

struct Version {
  std::uint32_t major = 0, minor = 0, patch = 0;

  friend auto operator<=>(const Version&, const Version&) = default;
};

struct Identity {
  std::string firmware;  ///< "Marlin 2.1.2 (Mar 1 2023 12:30:00)"; empty if unknown
  Family family = Family::unknown;
  std::optional<Version> version;
  std::string machine;                     ///< MACHINE_TYPE
  std::optional<std::uint32_t> extruders;  ///< EXTRUDER_COUNT; 1 for a Marlin with a mixing extruder
  std::map<std::string, bool> capabilities;

  /// Returns whether a Cap: line has announced the capability; false for firmwares without such lines.
  bool can(const std::string& capability) const;
  /// More than any firmware announces; further ones are dropped.
  static constexpr std::size_t most_capabilities = 100;
  void learn(const std::string& capability, bool on);
};

/// Parses the line that begins with FIRMWARE_NAME: and makes its text printable. Add capabilities with
/// learn().
Identity identify(std::string_view line);

}  // namespace unicursal::gcode
