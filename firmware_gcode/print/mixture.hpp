// The shares of the feeders in the plastic that leaves the nozzle.
#pragma once

#include <string>

#include "firmware_gcode/print/per_feeder.hpp"

namespace unicursal::gcode {

using Shares = PerFeeder;

/// Shares of all feeders of a printer; non-negative, sum 1. An all-zero mixture cannot be constructed, since
/// it hangs Marlin (sim/README.md, "Mixing in Marlin").
class Mixture {
 public:
  /// Normalises the shares. Throws core::DataError if one is negative, infinite or NaN, or if all are zero.
  explicit Mixture(const Shares& shares);
  /// Precondition: feeders > 0.
  static Mixture equal(std::size_t feeders) { return Mixture(Shares::all(feeders, 1)); }

  std::size_t feeders() const { return shares_.size(); }
  double share(std::size_t feeder) const { return shares_[feeder]; }
  const Shares& shares() const { return shares_; }
  /// Raises every share to at least `floor` and scales the others down in proportion. No feeder then stands
  /// still for long; plastic creeps back up an idle inlet. Precondition: 0 ≤ floor ≤ 1 ÷ feeders.
  Mixture with_floor(double floor) const;
  /// Rounds to `decimals` decimals by largest remainders: the rounded shares add up to exactly 1, and
  /// rounding again has no effect.
  Mixture quantised(int decimals) const;

  friend bool operator==(const Mixture&, const Mixture&) = default;

 private:
  Shares shares_;
};

/// The squared distance of two mixtures' shares. Precondition: as many feeders.
[[gnu::always_inline]] inline double squared_distance(const Shares& a, const Shares& b) {
  double sum = 0;
  for_each_feeder(a.size(), [&](std::size_t f) { sum += (a[f] - b[f]) * (a[f] - b[f]); });
  return sum;
}

/// The shares as text: "0.02 : 0.74 : 0.24".
std::string shares_text(const Mixture& mixture);

}  // namespace unicursal::gcode
