// The temperatures that a print begins with. °C.
#pragma once

#include "firmware_gcode/print/print_settings.hpp"
#include "firmware_gcode/print/printer.hpp"

namespace unicursal::gcode {

struct HeatTargets {
  double nozzle, bed;
};

/// The printer's temperatures, or those that the job sets for its first layer.
HeatTargets first_temperatures(const Printer& printer, const PrintSettings& settings);

}  // namespace unicursal::gcode
