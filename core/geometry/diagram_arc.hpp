// Pieces of the borders between cells of the segment diagram. mm.
#pragma once

#include <vector>

#include "core/geometry/polygon.hpp"

namespace unicursal::core {

/// Points this near to each other may or may not coincide, depending on rounding. mm.
constexpr double rounding_slack = 1e-9;

/// A piece of a cell's border as a quadratic Bézier curve: a straight line or a parabola. It starts and ends
/// exactly where its neighbours do, however these points were rounded. So cells are closed, and what rounding
/// takes from one cell it gives to the next.
struct Arc {
  Vec2 from{0, 0}, control{0, 0}, to{0, 0};

  Vec2 at(double s) const {
    return (1 - s) * ((1 - s) * from + s * control) + s * ((1 - s) * control + s * to);
  }
  Vec2 derivative(double s) const { return 2 * ((1 - s) * (control - from) + s * (to - control)); }
};

Arc line(const Vec2& from, const Vec2& to);

/// The parabola of points that are as far from `focus` as from the line through `base` along the unit vector
/// `along`. Both ends lie on it. Returns a straight line if there is no such parabola.
Arc parabola(const Vec2& from, const Vec2& to, const Vec2& focus, const Vec2& base, const Vec2& along);

/// Parameters in (0, 1) where an arc crosses a straight edge, or passes its ends within the slack: one cut
/// too many does no harm.
std::vector<double> crossings(const Arc& arc, const Vec2& a, const Vec2& b);

/// A box that contains the arc with the slack around it.
Box bounds(const Arc& arc);

}  // namespace unicursal::core
