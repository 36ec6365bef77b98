// A straight stretch between two points, mm.
#pragma once

#include "core/geometry/polygon.hpp"

namespace unicursal::core {

struct Segment {
  Vec2 a{0, 0}, b{0, 0};  ///< equal for a point
};

}  // namespace unicursal::core
