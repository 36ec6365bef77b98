// Whether a print that was made for one firmware may run on the printer that is there. In the wrong dialect
// every share of a mixture becomes zero, at which a Marlin stands still for ever with its heaters on.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "firmware_gcode/reply/identity.hpp"

namespace unicursal::host {

/// A question that changes nothing, since no printer has a feeder of that number: who does not know the
/// command has no mixing extruder.
inline constexpr auto mixing_question = "M163 S99 P1";
bool denies_mixing(const std::string& line);
/// The remedy is in it.
inline constexpr auto does_not_mix =
    "its feeders do not mix: it does not know M163; build its firmware with MIXING_EXTRUDER";

/// The profile's `firmware` for a family; nothing for those that this program does not speak to.
std::optional<std::string> dialect_of(gcode::Family family);

/// Why lines in the dialect `firmware` must not be sent to this printer, a clause; nothing when they may,
/// also to those that do not tell who they are.
std::optional<std::string> mismatch(const gcode::Identity& printer, const std::string& firmware);
/// What to do about that, before anything is printed.
std::string correction(const gcode::Identity& printer, const std::filesystem::path& profile);

/// What nobody has tried, a sentence; nothing for printers that are known.
std::optional<std::string> strangeness(const gcode::Identity& printer);

}  // namespace unicursal::host
