// Feeders that slip: one that has to turn 3 % more than the others to feed the same has the factor 1.03. No
// firmware keeps steps for each feeder of a mixing extruder, since E drives them all; so what each lacks is
// made up for in its share, and what all lack in E.
#pragma once

#include <array>

#include "firmware_gcode/dialect/dialect.hpp"

namespace unicursal::gcode {

/// A mixture as it is written to the firmware, and what comes of it.
struct CalibratedMixture {
  Mixture written;    ///< the shares in the firmware's lines
  Mixture delivered;  ///< the shares that then leave the nozzle
  double scale = 1;   ///< E ÷ the filament that is to be fed
};

/// Precondition: the factors are positive.
CalibratedMixture calibrated(const Mixture& wanted, const std::array<double, max_feeders>& factors,
                             const Dialect& dialect);

}  // namespace unicursal::gcode
