// A field of directions over an island and its integrals over cells (paper §3.2 (4), Appendix A (32),
// (37)–(41), Figure 29).
//
// A direction has no sign: θ and θ + π mean the same strand. The field therefore holds V = (cos 2θ, sin 2θ),
// which is the same vector for both, so that averages make sense. V is (0, 0) where no direction is asked
// for. V is constant in each square of a grid. Lengths in mm, angles in radians, V without unit, integrals of
// V in mm².
//
// Exact integrals: Green's theorem turns ∫ V over a polygon into a sum over its edges, of the integral over
// the area under each edge (37). For a piece of an edge within one square (39–41) that integral follows from
// sums along the columns of the grid (38).
//
// Departures from the paper: (41) is printed without the height of a grid square, which it needs as a factor
// (see `integral_under`). (37) counts leftward edges of a counter-clockwise ring as negative; here such a
// ring has a positive integral. A square that the border of a zone cuts holds the mean of the zones' vectors,
// weighted by area, so ‖V‖ may be less than 1 there. The square's part outside the island does not count, so
// cells clipped to the island see the field undiminished at the border.
#pragma once

#include <cmath>
#include <vector>

#include "core/field/grid.hpp"
#include "core/geometry/polygon.hpp"

namespace unicursal::core {

/// V of the direction `angle`.
inline Vec2 doubled(double angle) {
  return {std::cos(2 * angle), std::sin(2 * angle)};
}

/// V of the direction of `vector`; zero for the zero vector.
inline Vec2 doubled(const Vec2& vector) {
  const double length2 = vector.squaredNorm();
  if (!(length2 > 0)) return {0, 0};
  return Vec2(vector.x() * vector.x() - vector.y() * vector.y(), 2 * vector.x() * vector.y()) / length2;
}

/// The direction, in (−π/2, π/2], of V or of an integral of V. Precondition: not zero.
inline double direction(const Vec2& v) {
  return std::atan2(v.y(), v.x()) / 2;
}

class DirectionField {
 public:
  /// Asks for no direction anywhere.
  DirectionField() = default;
  /// One vector per square, ‖V‖ ≤ 1, and per square the share of its area that lies in the island.
  DirectionField(const Grid& grid, std::vector<Vec2> values, const std::vector<double>& island_share);

  /// Whether no direction is asked for anywhere; all integrals are then zero.
  bool empty() const { return !(aligned_area_ > 0); }
  /// ∫ ‖V‖ over the island, mm²: the area in which a direction is asked for. Part of Z in (35).
  double aligned_area() const { return aligned_area_; }
  const Grid& grid() const { return grid_; }

  /// V of the square that contains the point; zero outside the grid.
  Vec2 at(const Vec2& point) const;

  /// ∫ V over the area between the edge a → b and the lower side of the grid; negative if the edge runs
  /// towards −x. Exact.
  Vec2 integral_under(const Vec2& a, const Vec2& b) const;
  /// ∫ V over the inside, exact. Negative for clockwise rings, so that holes subtract.
  Vec2 integral(const Ring& ring) const;
  Vec2 integral(const Polygon& polygon) const;

  /// ∫ V over the rectangle of this width around the line a → b, exact.
  Vec2 integral_around(const Vec2& a, const Vec2& b, double width) const;
  /// An approximation from V at 2 × 2 Gauss points, about 15 times faster (20 ns). For sides of up to four
  /// squares the mean error is 1 % of the rectangle's area. It is up to a third if the border of a zone or of
  /// the island cuts the rectangle.
  Vec2 quick_integral_around(const Vec2& a, const Vec2& b, double width) const;

 private:
  Grid grid_;
  std::vector<Vec2> values_;
  std::vector<Vec2> sums_;  ///< SV (38): sum over a square and all below it in its column
  double aligned_area_ = 0;
};

}  // namespace unicursal::core
