// A straight line between two points, mm.
#pragma once

#include "core/geometry/polygon.hpp"

namespace unicursal::core {

struct Segment {
  Vec2 a{0, 0}, b{0, 0};  ///< equal if the segment is a point
};

}  // namespace unicursal::core
