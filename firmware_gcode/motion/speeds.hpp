// How fast a move may run. mm, mm/s.
#pragma once

#include <array>

#include "core/geometry/polygon.hpp"

namespace unicursal::gcode {

/// Greatest speed along `displacement` at which neither the x nor the y axis exceeds its own limit.
/// Precondition: the displacement is not zero.
double axis_limited_speed(const core::Vec2& displacement, const std::array<double, 3>& limits);

}  // namespace unicursal::gcode
