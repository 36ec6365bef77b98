// The speed at which a firmware passes from one move to the next. There are two rules, as in Marlin 2.1
// (sim/README.md, "Marlin 2.1"): classic jerk, by which the speed of each axis may jump by a fixed amount,
// and junction deviation, by which a corner is taken like an arc that deviates from it by a fixed distance.
// mm, mm/s, mm/s².
//
// sim/motion/junction.hpp has the same rules on purpose: the simulator is independent, so that a mistake in
// one of them cannot hide in the other.
#pragma once

#include <array>

#include "firmware_gcode/print/printer.hpp"

namespace unicursal::gcode {

/// x y z and e; e is the filament of all feeders together.
using PerAxis = std::array<double, 4>;

/// A move as the rules see it.
struct Course {
  PerAxis direction{};  ///< mm of each axis per mm along the move
  double length = 0;
  double speed = 0;         ///< along the move, within the limits of the axes
  double acceleration = 0;  ///< along the move
};

/// The greatest speed at the start of a move that begins at standstill.
double speed_from_rest(const Course& move, const Printer& printer);

/// The greatest speed at the corner between two moves.
double junction_speed(const Course& before, const Course& after, const Printer& printer);

/// The speed that is reached over `length` from `speed`; also the speed from which it brakes to `speed`.
double speed_after(double speed, double acceleration, double length);

}  // namespace unicursal::gcode
