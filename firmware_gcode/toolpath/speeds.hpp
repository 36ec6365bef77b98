// How fast a move may run and how long it takes. mm, mm/s, mm/s², mm³/s, s.
#pragma once

#include <array>

#include "core/geometry/polygon.hpp"
#include "firmware_gcode/toolpath/printer.hpp"

namespace unicursal::gcode {

/// Greatest speed along `displacement` at which neither the x nor the y axis exceeds its own limit.
/// Precondition: the displacement is not zero.
double axis_limited_speed(const core::Vec2& displacement, const std::array<double, 3>& limits);

/// Paper §4.2, constant flow: speed = flow ÷ (bead width × layer height), within what the axes can do.
/// `volume` (mm³) is spread over `displacement`; a move without volume runs as fast as the axes can.
double bead_speed(const core::Vec2& displacement, double volume, double flow, const Printer& printer);

/// Time of a move from rest to rest with constant acceleration.
double trapezoid_seconds(double distance, double speed, double acceleration);

}  // namespace unicursal::gcode
