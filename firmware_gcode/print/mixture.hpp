// The shares of the feeders in the plastic that leaves the nozzle.
#pragma once

#include <array>
#include <cstddef>
#include <string>

namespace unicursal::gcode {

inline constexpr std::size_t max_feeders = 3;

/// Shares of feeders 1…3; non-negative, sum 1. An all-zero mixture cannot be constructed, since it hangs
/// Marlin (sim/README.md, "Mixing in Marlin").
class Mixture {
 public:
  /// Normalises the shares. Throws core::DataError if one is negative, infinite or NaN, or if all are zero.
  explicit Mixture(const std::array<double, max_feeders>& shares);

  double share(std::size_t feeder) const { return shares_[feeder]; }
  const std::array<double, max_feeders>& shares() const { return shares_; }
  /// Raises every share to at least `floor` and scales the others down in proportion. No feeder then stands
  /// still for long; plastic creeps back up an idle inlet. Precondition: 0 ≤ floor ≤ 1/3.
  Mixture with_floor(double floor) const;
  /// Rounds to `decimals` decimals by largest remainders: the rounded shares add up to exactly 1, and
  /// rounding again has no effect.
  Mixture quantised(int decimals) const;

  friend bool operator==(const Mixture&, const Mixture&) = default;

 private:
  std::array<double, max_feeders> shares_;
};

/// The squared distance of two mixtures' shares.
inline double squared_distance(const std::array<double, max_feeders>& a,
                               const std::array<double, max_feeders>& b) {
  double sum = 0;
  for (std::size_t f = 0; f < max_feeders; ++f) sum += (a[f] - b[f]) * (a[f] - b[f]);
  return sum;
}

/// The shares as text: "0.02 : 0.74 : 0.24".
std::string shares_text(const Mixture& mixture);

}  // namespace unicursal::gcode
