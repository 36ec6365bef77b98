// Whether a print that was made for one firmware may run on the connected printer. In the wrong dialect every
// share of a mixture becomes zero, and Marlin then hangs with its heaters on.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "firmware_gcode/reply/identity.hpp"

namespace unicursal::host {

/// A command that changes nothing and shows whether feeders mix: shares for a feeder that no printer has, or
/// the question for the shares of RepRapFirmware's tool.
std::string mixing_question(const std::string& firmware);
/// Whether a line says that the printer cannot carry out what mixing_question() asks.
bool denies_mixing(const std::string& line);
/// The number of feeders that meet in RepRapFirmware's tool, from "Tool 0 mix ratios: 1.000:0.000:0.000"
/// (GCodes2.cpp of RepRapFirmware 3.5.3, M567); nullopt for any other line.
std::optional<std::size_t> mixing_feeders(const std::string& line);
/// Sentences with their remedies.
std::string does_not_mix(const std::string& firmware);
std::string mixes_other_feeders(std::size_t has, std::size_t wanted);

/// The highest virtual tool that lines define, by "M164 S5"; absent if they define none.
std::optional<unsigned> highest_tool(const std::vector<std::string>& lines);
/// Why a print that needs the tools up to `highest` cannot run, a sentence with its remedy. A Marlin with
/// fewer answers T5 by "echo:T5 Invalid extruder" and keeps the tool that it had (Marlin 2.1,
/// invalid_extruder_error()). Repetier selects T0 instead and does not say so; its VIRTUAL_EXTRUDER cannot be
/// asked.
std::string lacks_tools(unsigned highest);
/// Why the feeders of a Repetier are not the wanted number, a sentence with its remedy; absent if they are,
/// and for other firmwares: a Marlin that mixes counts all its feeders as one extruder. A feeder more is not
/// harmless: no mixture would name it, and it would keep the part that it has in a tool after a reset.
std::optional<std::string> has_other_feeders(const gcode::Identity& printer, std::size_t wanted);

/// The profile's word for a family of firmware; absent for families that this program does not support.
std::optional<std::string> dialect_of(gcode::Family family);

/// Why lines in the dialect `firmware` must not be sent to this printer, a clause; absent if they may. A
/// printer that does not name its firmware is accepted.
std::optional<std::string> mismatch(const gcode::Identity& printer, const std::string& firmware);
/// The remedy for that.
std::string correction(const gcode::Identity& printer, const std::filesystem::path& profile);

/// A warning about a firmware that this program has never met, a sentence; absent for known ones.
std::optional<std::string> strangeness(const gcode::Identity& printer);

}  // namespace unicursal::host
