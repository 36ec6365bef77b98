// How fast the machine may pass from one move to the next. Two rules, as Marlin 2.1 has them: classic jerk,
// by which every axis may jump by so much in speed, and junction deviation, by which a corner is taken like
// an arc that strays from it by so much. mm/s, mm/s², mm.
#pragma once

#include <array>
#include <cstddef>

namespace unicursal::sim {

enum Axis : std::size_t { axis_x, axis_y, axis_z, axis_e };
inline constexpr std::size_t axes = 4;
template <class T>
using PerAxis = std::array<T, axes>;  ///< x y z e; e is filament of all feeders together

/// What the rules know of a move.
struct MoveShape {
  PerAxis<double> direction{};  ///< mm of each axis for 1 mm along the move
  double nominal = 0;           ///< speed
  double length = 0;
};

/// The greatest speed along `move` at which no axis exceeds its jerk when the machine stands before or after.
double speed_from_rest(const MoveShape& move, const PerAxis<double>& jerk);

/// Classic jerk. An axis that turns round jumps by the greater of its two speeds, not by their sum. Where
/// both moves could start from rest faster than the corner would allow, they are joined at that speed
/// instead.
double jerk_speed(const MoveShape& before, const MoveShape& after, const PerAxis<double>& jerk);

/// Junction deviation, with the rule for arcs of short moves: on a turn of less than 45° a move under 1 mm
/// also limits the speed by its own curvature, length ÷ angle.
double deviation_speed(const MoveShape& before, const MoveShape& after, double deviation,
                       const PerAxis<double>& max_acceleration, double acceleration);

}  // namespace unicursal::sim
