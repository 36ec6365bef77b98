// What a slicer's file may ask of the printer beyond the profile. °C.
#pragma once

namespace unicursal::gcode {

struct SlicedLimits {
  double hottest_nozzle = 450, hottest_bed = 200;
  /// The file may wait for a person (M0, M1, M25, M226, M600, M601).
  bool allow_stops = false;
};

}  // namespace unicursal::gcode
