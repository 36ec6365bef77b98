// Nothing leaves the host that the printer cannot do. Every function throws core::DataError, naming the
// place and the remedy, and has no other effect.
#pragma once

#include <string>
#include <vector>

#include "firmware_gcode/print/print_settings.hpp"
#include "firmware_gcode/print/printer.hpp"

namespace unicursal::gcode {

/// Sizes, speeds, temperatures and feeders of the machine.
void check_printer(const Printer& printer);
/// Flow, materials and their zones.
void check_settings(const PrintSettings& settings, const Printer& printer);
/// Every position inside the bed, every number finite, every zone known.
void check_layer(const PlacedLayer& layer, const PrintSettings& settings, const Printer& printer);
/// Of the first layer that prints anything: it lies on the bed.
void check_on_bed(const PlacedLayer& layer);

/// The commands in a piece of a user's own G-code: comments and blank lines dropped. Refuses what would
/// break the numbering of lines (M110, N…, '*') and lines that a firmware would cut. `key` names the text.
std::vector<std::string> user_commands(const std::string& text, const std::string& key);

}  // namespace unicursal::gcode
