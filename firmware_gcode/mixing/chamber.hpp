// How the chamber answers: what leaves the nozzle when the feeders' mixture changes. mm³.
// Model: `dead_volume` passes unmixed, then equal stirred tanks in series, which `mixing_volume` takes from
// the first trace of a step to 95 % of it. The answer to a step is the distribution function of a gamma law
// whose shape is the number of tanks (residence times of tanks in series; a textbook result of reaction
// engineering).
#pragma once

#include <array>
#include <cstddef>

#include "firmware_gcode/print/mixture.hpp"

namespace unicursal::gcode {

inline constexpr std::size_t max_tanks = 8;

struct ChamberModel {
  double dead_volume = 2.1;
  double mixing_volume = 4.0;  ///< 0: a change is sharp
  std::size_t tanks = 2;       ///< 1 … max_tanks

  /// The volume of one tank.
  double tank_volume() const;
  /// What has arrived of a new mixture, 0…1, when `volume` has passed since it was switched to.
  double step_response(double volume) const;
  /// The inverse: the volume after which `share` (0…1, not 1) of the change has arrived; at least the dead
  /// volume.
  double delay(double share) const;
  /// By how much a slow, even change comes late.
  double mean_delay() const;
};

/// The tanks behind the dead volume, at work.
class Tanks {
 public:
  using Shares = std::array<double, max_feeders>;

  /// All full of `shares`.
  Tanks(const ChamberModel& model, const Shares& shares);

  /// Lets `volume` (above zero) of constant shares flow in; gives the mean shares of what flows out
  /// meanwhile. Exact.
  Shares pass(const Shares& inflow, double volume);
  /// The greatest difference of any share in any tank.
  double difference(const Tanks& other) const;
  double difference(const Shares& shares) const;

 private:
  std::size_t count_;
  double tank_volume_;
  std::array<Shares, max_tanks> tanks_{};
};

/// Half the sum of the differences of all shares: the part of the plastic that is in the wrong place.
inline double misplaced(const std::array<double, max_feeders>& a, const std::array<double, max_feeders>& b) {
  double sum = 0;
  for (std::size_t f = 0; f < max_feeders; ++f) sum += a[f] < b[f] ? b[f] - a[f] : a[f] - b[f];
  return sum / 2;
}

}  // namespace unicursal::gcode
