// Predicates that are exact for coordinates in double precision, by CGAL's exact kernel.
#pragma once

#include "core/geometry/polygon.hpp"

namespace unicursal::core {

/// Sign of the area of the triangle a, b, c, exact for doubles; +1 counter-clockwise, 0 collinear.
int orientation(const Vec2& a, const Vec2& b, const Vec2& c);

}  // namespace unicursal::core
