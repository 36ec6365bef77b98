// How fast a move may run. mm, mm³, mm/s, mm³/s.
#pragma once

#include <array>

#include "core/geometry/polygon.hpp"
#include "firmware_gcode/print/print_settings.hpp"
#include "firmware_gcode/print/printer.hpp"

namespace unicursal::gcode {

/// The greatest speed along `displacement` at which neither the x nor the y axis exceeds its own limit.
/// Precondition: the displacement is not zero.
double axis_limited_speed(const core::Vec2& displacement, const std::array<double, 3>& limits);

struct LaidBead {
  core::Vec2 displacement;
  double volume;
  std::size_t layer;  ///< of its part; the first may be slower
  double layer_height;
};

/// The speed of a bead that is laid with `flow`, or with the speed of the settings if they have one
/// (laying_speed.hpp). Precondition: the displacement is not zero.
double bead_speed(const LaidBead& bead, double flow, const PrintSettings& settings, const Printer& printer);

}  // namespace unicursal::gcode
