// A closed curve, parametrised by the length along it, mm. Positions are taken modulo the curve's length.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "core/curve/curve.hpp"

namespace unicursal::core {

class Track {
 public:
  /// Precondition: at least three vertices, not all at the same point.
  explicit Track(Curve curve) : curve_(std::move(curve)), starts_(curve_.size() + 1) {
    for (std::size_t i = 0; i < curve_.size(); ++i) {
      starts_[i + 1] = starts_[i] + (curve_.vertices[curve_.after(i)] - curve_.vertices[i]).norm();
    }
  }

  const Curve& curve() const { return curve_; }
  double length() const { return starts_.back(); }
  /// The position of vertex `i`.
  double start(std::size_t i) const { return starts_[i]; }

  /// The position in [0, length()) that is the same as `s`.
  double wrapped(double s) const {
    const double turn = s - std::floor(s / length()) * length();
    return turn < length() ? turn : 0.0;
  }
  /// The distance between two positions along the curve, the shorter way.
  double distance(double s, double t) const {
    const double ahead = wrapped(t - s);
    return std::min(ahead, length() - ahead);
  }
  /// The segment on which a position lies.
  std::size_t segment_at(double s) const {
    const auto after = std::upper_bound(starts_.begin(), starts_.end() - 1, wrapped(s));
    return static_cast<std::size_t>(after - starts_.begin()) - 1;
  }
  Vec2 at(double s) const {
    const std::size_t i = segment_at(s);
    const double span = starts_[i + 1] - starts_[i];
    const Vec2 &a = curve_.vertices[i], &b = curve_.vertices[curve_.after(i)];
    return span > 0 ? Vec2(a + (wrapped(s) - starts_[i]) / span * (b - a)) : a;
  }
  /// The points of the curve from position `from` forwards to `to`, both included.
  std::vector<Vec2> stretch(double from, double to) const {
    std::vector<Vec2> points{at(from)};
    const double way = wrapped(to - from);
    std::size_t i = segment_at(from);
    for (std::size_t n = 0; n < curve_.size(); ++n) {
      i = curve_.after(i);
      const double passed = wrapped(starts_[i] - from);
      if (passed > way - shortest) break;
      if (passed > shortest) points.push_back(curve_.vertices[i]);
    }
    points.push_back(at(to));
    return points;
  }

 private:
  static constexpr double shortest = 1e-6;  ///< mm; vertices nearer to an end are left out

  Curve curve_;
  std::vector<double> starts_;
};

}  // namespace unicursal::core
