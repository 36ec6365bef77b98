// One number for each feeder of a printer: the shares of a mixture, volumes, factors of calibration. The
// numbers lie in place, without an allocation, since the schedule copies many of them.
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <initializer_list>

namespace unicursal::gcode {

/// As many extruder motors as Marlin 2.1 can drive (E0 to E7 in its pins.h); a nozzle mixes two or more.
inline constexpr std::size_t most_feeders = 8;
inline constexpr std::size_t least_feeders = 2;
inline constexpr std::size_t usual_feeders = 3;

/// Calls `each(f)` for f = 0 … feeders − 1. The compiler unrolls the loop for the usual number.
template <class Each>
[[gnu::always_inline]] inline void for_each_feeder(std::size_t feeders, Each&& each) {
  if (feeders == usual_feeders) {
    for (std::size_t f = 0; f < usual_feeders; ++f) each(f);
    return;
  }
  for (std::size_t f = 0; f < feeders; ++f) each(f);
}

class PerFeeder {
 public:
  using value_type = double;
  using iterator = double*;
  using const_iterator = const double*;

  /// For no feeder.
  PerFeeder() = default;
  /// Precondition: at most `most_feeders` values.
  PerFeeder(std::initializer_list<double> values) : PerFeeder(of(values)) {}

  /// The same number for every feeder. Precondition: feeders ≤ most_feeders.
  static PerFeeder all(std::size_t feeders, double value) {
    PerFeeder result = zeros(feeders);
    std::fill_n(result.values_.begin(), feeders, value);
    return result;
  }
  static PerFeeder zeros(std::size_t feeders) {
    assert(feeders <= most_feeders);
    PerFeeder result;
    result.size_ = feeders;
    return result;
  }
  /// Precondition: at most `most_feeders` values.
  template <class Range>
  static PerFeeder of(const Range& values) {
    PerFeeder result = zeros(static_cast<std::size_t>(values.end() - values.begin()));
    std::copy(values.begin(), values.end(), result.begin());
    return result;
  }

  std::size_t size() const { return size_; }
  double& operator[](std::size_t feeder) { return values_[feeder]; }
  double operator[](std::size_t feeder) const { return values_[feeder]; }
  iterator begin() { return values_.data(); }
  iterator end() { return values_.data() + size_; }
  const_iterator begin() const { return values_.data(); }
  const_iterator end() const { return values_.data() + size_; }

  friend bool operator==(const PerFeeder& a, const PerFeeder& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end());
  }

 private:
  std::array<double, most_feeders> values_{};
  std::size_t size_ = 0;
};

}  // namespace unicursal::gcode
