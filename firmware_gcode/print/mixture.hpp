// Shares of the feeders in what leaves the nozzle.
#pragma once

#include <array>
#include <cstddef>
#include <string>

namespace unicursal::gcode {

inline constexpr std::size_t max_feeders = 3;

/// Shares of feeders 1…3; non-negative, at least one positive, sum 1. An all-zero mixture hangs Marlin
/// (firmware-facts), so one cannot be made.
class Mixture {
 public:
  /// Normalises. Throws core::DataError when a share is negative, infinite or NaN, or when all are zero.
  explicit Mixture(const std::array<double, max_feeders>& shares);

  double share(std::size_t feeder) const { return shares_[feeder]; }
  const std::array<double, max_feeders>& shares() const { return shares_; }
  /// Every share at least `floor`, the rest scaled down in proportion: no feeder ever stands still for long,
  /// since plastic creeps back up an idle inlet. Precondition: 0 ≤ floor ≤ 1/3.
  Mixture with_floor(double floor) const;
  /// In whole units of the last of `decimals` decimals, by largest remainders: the units add up to 1 exactly,
  /// so that what is written is what is normalised, and doing it again changes nothing.
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

/// For people: "0.02 : 0.74 : 0.24".
std::string shares_text(const Mixture& mixture);

}  // namespace unicursal::gcode
