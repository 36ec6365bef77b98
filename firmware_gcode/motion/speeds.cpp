#include "firmware_gcode/motion/speeds.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace unicursal::gcode {

double axis_limited_speed(const core::Vec2& displacement, const std::array<double, 3>& limits) {
  const double length = displacement.norm();
  assert(length > 0);
  double speed = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 2; ++axis) {
    const double share = std::abs(displacement[axis]) / length;
    if (share > 0) speed = std::min(speed, limits[static_cast<std::size_t>(axis)] / share);
  }
  return speed;
}

}  // namespace unicursal::gcode
