// The speed at which the machine may pass from one move to the next, by the two rules of Marlin 2.1
// (planner.cpp): classic jerk limits the jump in speed of each axis; junction deviation replaces a corner by
// an arc that deviates from it by a given distance. mm/s, mm/s², mm.
//
// firmware_gcode/motion/junction.hpp implements the same rules. The two share no code on purpose: the
// simulator is independent of the program that it checks.
#pragma once

#include <array>
#include <cstddef>

namespace unicursal::sim {

enum Axis : std::size_t { axis_x, axis_y, axis_z, axis_e };
inline constexpr std::size_t axes = 4;
template <class T>
using PerAxis = std::array<T, axes>;  ///< x y z e; e is the filament of all feeders together.

/// The properties of a move that the rules need.
struct MoveShape {
  PerAxis<double> direction{};  ///< Distance of each axis for 1 mm along the move.
  double nominal = 0;           ///< Speed.
  double length = 0;
};

/// The highest speed along `move` at which it may start from rest, or stop: no axis exceeds its jerk.
double speed_from_rest(const MoveShape& move, const PerAxis<double>& jerk);

/// Junction speed by classic jerk. An axis that reverses jumps by the greater of its two speeds, not by their
/// sum. If both moves may start from rest faster than the corner allows, they are joined at that speed.
double jerk_speed(const MoveShape& before, const MoveShape& after, const PerAxis<double>& jerk);

/// Junction speed by junction deviation, with the rule for arcs of short moves: at a turn of less than 45° a
/// move under 1 mm also limits the speed by its own radius, length ÷ angle.
double deviation_speed(const MoveShape& before, const MoveShape& after, double deviation,
                       const PerAxis<double>& max_acceleration, double acceleration);

}  // namespace unicursal::sim
