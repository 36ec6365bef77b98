// Who a firmware is: its answer to M115 as typed values.
//
//   FIRMWARE_NAME:Marlin 2.1.2 (Mar 1 2023 12:30:00) SOURCE_CODE_URL:… EXTRUDER_COUNT:1 UUID:…
//   Cap:AUTOREPORT_TEMP:1
//
// Marlin, Repetier, RepRapFirmware, Smoothieware and Klipper all answer in this form; only newer ones add
// FIRMWARE_VERSION or lines of Cap:. Hostile input as every reply: bounded, nothing trusted.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace unicursal::gcode {

enum class Family { unknown, marlin, repetier, reprapfirmware, klipper, smoothieware };

/// "Marlin", …; "unknown" for those that are not known.
std::string_view name(Family family);

struct Version {
  std::uint32_t major = 0, minor = 0, patch = 0;

  friend auto operator<=>(const Version&, const Version&) = default;
};

struct Identity {
  std::string firmware;  ///< "Marlin 2.1.2 (Mar 1 2023 12:30:00)"; empty when it has told nothing
  Family family = Family::unknown;
  std::optional<Version> version;
  std::string machine;                     ///< MACHINE_TYPE
  std::optional<std::uint32_t> extruders;  ///< EXTRUDER_COUNT; 1 in a Marlin whose feeders mix
  std::map<std::string, bool> capabilities;

  /// What a Cap: line has promised; firmwares that have no such lines promise nothing.
  bool can(const std::string& capability) const;
  /// More than any firmware tells; the rest of a flood is dropped.
  static constexpr std::size_t most_capabilities = 100;
  void learn(const std::string& capability, bool on);
};

/// From the line that begins with FIRMWARE_NAME:, which becomes printable. Capabilities follow by learn().
Identity identify(std::string_view line);

}  // namespace unicursal::gcode
