// Geometric predicates that are exact for coordinates in double precision, evaluated by CGAL.
#pragma once

#include "core/geometry/polygon.hpp"

namespace unicursal::core {

/// Orientation of the triangle a, b, c: +1 counter-clockwise, −1 clockwise, 0 collinear. Exact.
int orientation(const Vec2& a, const Vec2& b, const Vec2& c);

}  // namespace unicursal::core
