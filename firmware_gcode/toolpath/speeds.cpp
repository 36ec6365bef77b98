#include "firmware_gcode/toolpath/speeds.hpp"

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

double bead_speed(const core::Vec2& displacement, double volume, double flow, const Printer& printer) {
  const double limit = axis_limited_speed(displacement, printer.max_speed);
  // flow ÷ (width × height) with width × height = volume ÷ length
  return volume > 0 ? std::min(limit, flow * displacement.norm() / volume) : limit;
}

double trapezoid_seconds(double distance, double speed, double acceleration) {
  const double ramps = speed * speed / acceleration;  // mm, speeding up and slowing down together
  if (distance < ramps) return 2 * std::sqrt(distance / acceleration);
  return distance / speed + speed / acceleration;
}

}  // namespace unicursal::gcode
