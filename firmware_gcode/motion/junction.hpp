// How fast a firmware passes from one move to the next. Two rules, as in Marlin 2.1 (firmware facts, motion
// defaults; both are read in its source): classic jerk, by which every axis may jump by so much in speed, and
// junction deviation, by which a corner is taken like an arc that strays from it by so much.
// mm, mm/s, mm/s².
#pragma once

#include <array>

#include "firmware_gcode/print/printer.hpp"

namespace unicursal::gcode {

/// x y z and e, which is filament of all feeders together.
using PerAxis = std::array<double, 4>;

/// What the rules know of a move.
struct Course {
  PerAxis direction{};  ///< mm of each axis for 1 mm along the move
  double length = 0;
  double speed = 0;         ///< along it, within what the axes can do
  double acceleration = 0;  ///< along it
};

/// Greatest speed at the start of a move when the machine stands before it.
double speed_from_rest(const Course& move, const Printer& printer);

/// Greatest speed at which one move may pass into the other.
double junction_speed(const Course& before, const Course& after, const Printer& printer);

/// The speed that is reached over `length` from `speed`, or from which one brakes to it.
double speed_after(double speed, double acceleration, double length);

}  // namespace unicursal::gcode
