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

double bead_speed(const LaidBead& bead, double flow, const PrintSettings& settings, const Printer& printer) {
  const double factor = bead.layer == 0 ? settings.first_layer_speed : 1;
  const double length = bead.displacement.norm();
  double speed = axis_limited_speed(bead.displacement, printer.max_speed);
  if (settings.speed) {
    speed = std::min(speed, factor * *settings.speed);
    return bead.volume > 0 ? std::min(speed, printer.max_flow * length / bead.volume) : speed;
  }
  const double thinnest = printer.bead_width_range[0] * bead.layer_height;  // mm², cross-section
  return std::min(speed, factor * flow / std::max(thinnest, bead.volume / length));
}

}  // namespace unicursal::gcode
