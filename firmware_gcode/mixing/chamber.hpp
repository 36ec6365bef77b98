// The chamber's response: what leaves the nozzle when the feeders' mixture changes. mm³.
//
// Model: plug flow through `dead_volume`, then equal stirred tanks in series. `mixing_volume` passes from the
// first trace of a step to 95 % of it. The step response is the distribution function of a gamma law whose
// shape is the number of tanks (residence times of tanks in series, a textbook result of reaction
// engineering).
//
// sim/nozzle/chamber.hpp has the same model on purpose: the simulator is independent, so that a mistake in
// one of them cannot hide in the other.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "firmware_gcode/print/mixture.hpp"

namespace unicursal::gcode {

inline constexpr std::size_t max_tanks = 8;

struct ChamberModel {
  double dead_volume = 2.1;
  double mixing_volume = 4.0;  ///< 0: changes are sharp
  std::size_t tanks = 2;       ///< 1 … max_tanks

  /// The volume of one tank.
  double tank_volume() const;
  /// The fraction of a new mixture, 0…1, in the outflow when `volume` has passed since the switch.
  double step_response(double volume) const;
  /// The inverse: the volume after which the fraction `share` of a change has arrived; at least the dead
  /// volume. Precondition: 0 ≤ share < 1.
  double delay(double share) const;
  /// The delay of a slow, linear change.
  double mean_delay() const;
};

/// The state of the tanks behind the dead volume.
class Tanks {
 public:
  /// All tanks are full of `shares`.
  Tanks(const ChamberModel& model, const Shares& shares);

  /// Lets `volume` (above zero) of constant shares flow in and returns the mean shares of the outflow
  /// meanwhile. The solution is exact.
  Shares pass(const Shares& inflow, double volume);
  /// Whether no share of any tank differs by `least` or more.
  bool is_like(const Tanks& other, double least) const;

  /// The schedule copies tanks often: only what is used is copied.
  Tanks(const Tanks& other) { *this = other; }
  Tanks& operator=(const Tanks& other);

 private:
  double& share(std::size_t tank, std::size_t feeder) { return shares_[tank * feeders_ + feeder]; }
  double share(std::size_t tank, std::size_t feeder) const { return shares_[tank * feeders_ + feeder]; }

  std::size_t count_, feeders_;
  double tank_volume_;
  std::array<double, max_tanks * most_feeders> shares_;  ///< of the tanks in turn; behind the last unused
};

/// The fraction of plastic that is misplaced: half the sum of the absolute differences of all shares.
[[gnu::always_inline]] inline double misplaced(const Shares& a, const Shares& b) {
  double sum = 0;
  for_each_feeder(a.size(), [&](std::size_t f) { sum += std::abs(a[f] - b[f]); });
  return sum / 2;
}

}  // namespace unicursal::gcode
