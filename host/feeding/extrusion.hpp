// Pushing filament by hand, all feeders together, from wherever the nozzle is. mm.
#pragma once

#include <string>
#include <vector>

#include "firmware_gcode/print/printer.hpp"

namespace unicursal::host {

/// Lines that push `length` mm in equal shares, or draw them back if it is negative, slowly enough to melt.
/// Precondition: the nozzle is hot, and the printer is checked.
std::vector<std::string> extrusion(double length, const gcode::Printer& printer);

}  // namespace unicursal::host
