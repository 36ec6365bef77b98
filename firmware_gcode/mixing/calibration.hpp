// Feeders that slip: one that has to turn 3 % more than the others to feed the same has the factor 1.03. No
// firmware keeps steps for each feeder of a mixing extruder, since E drives them all; so what each lacks is
// made up for in its share, and what all lack in E.
#pragma once

#include <array>

#include "firmware_gcode/dialect/dialect.hpp"

namespace unicursal::gcode {

/// How a mixture is told to the firmware so that it comes out.
struct WrittenTool {
  Mixture written;    ///< what the firmware is told
  Mixture delivered;  ///< what leaves the nozzle then
  double scale = 1;   ///< E ÷ the filament that is to be fed
};

/// Precondition: the factors are positive.
WrittenTool calibrated(const Mixture& wanted, const std::array<double, max_feeders>& factors,
                       const Dialect& dialect);

}  // namespace unicursal::gcode
