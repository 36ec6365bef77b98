#include "firmware_gcode/print/heat_targets.hpp"

namespace unicursal::gcode {

HeatTargets first_temperatures(const Printer& printer, const PrintSettings& settings) {
  HeatTargets first{printer.nozzle_temperature, printer.bed_temperature};
  for (const LayerTemperature& change : settings.temperatures) {
    if (change.layer > 0) break;
    first = {change.nozzle.value_or(first.nozzle), change.bed.value_or(first.bed)};
  }
  return first;
}

}  // namespace unicursal::gcode
