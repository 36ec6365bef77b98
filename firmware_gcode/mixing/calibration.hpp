// Calibration of feeders that slip. A feeder that must turn 3 % more than the others to feed the same has the
// factor 1.03. No firmware keeps steps per feeder of a mixing extruder, since E drives all feeders together.
// So the difference between feeders is corrected in the shares, and the common part in E.
#pragma once

#include "firmware_gcode/dialect/dialect.hpp"

namespace unicursal::gcode {

/// A mixture as it is written to the firmware, and the mixture that results.
struct CalibratedMixture {
  Mixture written;    ///< the shares in the firmware's lines
  Mixture delivered;  ///< the shares that leave the nozzle
  double scale = 1;   ///< E ÷ mm of filament to be fed
};

/// Precondition: the factors are positive, one for each feeder of the mixture.
CalibratedMixture calibrated(const Mixture& wanted, const PerFeeder& factors, const Dialect& dialect);

}  // namespace unicursal::gcode
