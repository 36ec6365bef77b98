// Checks that the printer can carry out what it is asked. Every function throws core::DataError, which names
// the place and the remedy, and has no other effect.
#pragma once

#include <string>
#include <vector>

#include "firmware_gcode/print/print_settings.hpp"
#include "firmware_gcode/print/printer.hpp"

namespace unicursal::gcode {

/// Checks sizes, speeds, temperatures and feeders of the machine.
void check_printer(const Printer& printer);
/// Checks flow, speeds, materials and zones.
void check_settings(const PrintSettings& settings, const Printer& printer);
/// Checks that every position is inside the bed, every number finite, and every zone known.
void check_layer(const PlacedLayer& layer, const PrintSettings& settings, const Printer& printer);
/// Checks that the first layer with beads lies on the bed.
void check_on_bed(const PlacedLayer& layer);

/// Returns the commands in a piece of the user's own G-code, without comments and blank lines. Refuses
/// commands that break the numbering of lines (M110, N…, '*') and lines that a firmware would cut. `key`
/// names the text.
std::vector<std::string> user_commands(const std::string& text, const std::string& key);

}  // namespace unicursal::gcode
