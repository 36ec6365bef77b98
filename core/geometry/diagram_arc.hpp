// Stretches of the borders between cells of the segment diagram. mm.
#pragma once

#include <vector>

#include "core/geometry/polygon.hpp"

namespace unicursal::core {

constexpr double rounding_slack = 1e-9;  ///< at this distance, rounding decides whether two things touch, mm

/// A stretch of a cell's border as a quadratic Bézier curve, which a straight line and a parabola both are.
/// It starts and ends exactly where its neighbours do, however badly rounded these points are, so that cells
/// are closed and leave no gaps between them.
struct Arc {
  Vec2 from{0, 0}, control{0, 0}, to{0, 0};

  Vec2 at(double s) const {
    return (1 - s) * ((1 - s) * from + s * control) + s * ((1 - s) * control + s * to);
  }
  Vec2 derivative(double s) const { return 2 * ((1 - s) * (control - from) + s * (to - control)); }
};

Arc line(const Vec2& from, const Vec2& to);

/// The parabola of all points that are as far from `focus` as from the line through `base` along the unit
/// vector `along`. Precondition: both ends lie on it. A straight line if the focus lies on that line.
Arc parabola(const Vec2& from, const Vec2& to, const Vec2& focus, const Vec2& base, const Vec2& along);

/// Parameters in (0, 1) where an arc crosses a straight edge, or passes its ends within the slack: a
/// superfluous cut does no harm.
std::vector<double> crossings(const Arc& arc, const Vec2& a, const Vec2& b);

/// A box that holds the arc and the slack around it.
Box bounds(const Arc& arc);

}  // namespace unicursal::core
