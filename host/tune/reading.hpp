// Readings of a strip, from any source: a person at the terminal, the command line, or the simulator's
// raster.
#pragma once

#include <optional>
#include <stdexcept>

#include "host/tune/strip.hpp"
#include "host/tune/transition_fit.hpp"

namespace unicursal::host {

/// Places in mm along the bead from the switch: ticks × Strip::tick.
struct StripReading {
  double began = 0, stopped = 0;
  std::optional<double> half;  ///< where half of the change has come; absent if that could not be read
};

/// The user does not want to continue.
class TuningCancelled : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class StripReader {
 public:
  virtual ~StripReader() = default;
  /// Throws core::DataError if the strip cannot be read, or TuningCancelled.
  virtual StripReading read(const Strip& strip) = 0;
};

/// The volumes that have passed at these places, as ranges: each place is known up to the next printed tick.
/// Throws core::DataError for places that are not on the strip or not in order.
ReadVolumes volumes_of(const Strip& strip, const StripReading& reading);

/// The nearest printed tick, in mm along the bead like `along`.
double nearest_tick(const Strip& strip, double along);

}  // namespace unicursal::host
