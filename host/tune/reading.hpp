// Readings of a strip, wherever they come from: a person at the terminal, the command line, the simulator's
// raster, and one day a photo.
#pragma once

#include <optional>
#include <stdexcept>

#include "host/tune/strip.hpp"
#include "host/tune/transition_fit.hpp"

namespace unicursal::host {

/// mm along the bead from the switch; ticks × Strip::tick.
struct StripReading {
  double began = 0, stopped = 0;
  std::optional<double> half;  ///< where half of the change has come, if that could be told
};

/// The person does not want to go on.
class TuningCancelled : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class StripReader {
 public:
  virtual ~StripReader() = default;
  /// Throws core::DataError when nothing can be read, TuningCancelled.
  virtual StripReading read(const Strip& strip) = 0;
};

/// What has passed at those places, give or take the way to the next printed tick. Throws core::DataError for
/// a reading that is not on the strip or not in order.
ReadVolumes volumes_of(const Strip& strip, const StripReading& reading);

/// The printed tick that is nearest to a place, in mm along the bead.
double nearest_tick(const Strip& strip, double along);

}  // namespace unicursal::host
