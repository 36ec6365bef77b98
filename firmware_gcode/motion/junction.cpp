#include "firmware_gcode/motion/junction.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace unicursal::gcode {
namespace {

constexpr double standing = 0.05;        ///< mm/s that the firmware treats as standstill
constexpr double no_corner = 0.999999;   ///< cosine of a turn above which there is no corner
constexpr double nearly_as_fast = 0.99;  ///< of the corner's speed; a start from rest then replaces it
constexpr double short_move = 1;         ///< mm; shorter ones may be chords of an arc
constexpr double arc_turn = 0.70711;     ///< cosine of the greatest turn between the chords of an arc

PerAxis normalised(PerAxis v) {
  double square = 0;
  for (double x : v) square += x * x;
  for (double& x : v) x /= std::sqrt(square);
  return v;
}

/// The jump of an axis per mm/s along both moves. An axis that reverses stops in between.
double jump(double before, double after) {
  if (before * after < 0) return std::max(std::abs(before), std::abs(after));
  return std::abs(before - after);
}

PerAxis jerks(const Printer& printer) {
  const Motion& m = printer.motion;
  return {m.jerk[0], m.jerk[1], m.jerk[2], m.extruder_jerk};
}

double by_jerk(const Course& before, const Course& after, const Printer& printer) {
  const double both = std::min(before.speed, after.speed);
  const PerAxis jerk = jerks(printer);
  double corner = both;
  for (std::size_t axis = 0; axis < jerk.size(); ++axis) {
    const double change = jump(before.direction[axis], after.direction[axis]);
    if (change * corner > jerk[axis]) corner = jerk[axis] / change;
  }
  const double rest = speed_from_rest(after, printer);
  const bool rest_is_faster = std::min(rest, speed_from_rest(before, printer)) > corner * nearly_as_fast;
  return rest_is_faster ? std::min(rest, both) : corner;
}

/// The greatest acceleration along `direction` within the limits of all axes.
double axis_limited(const PerAxis& direction, double acceleration, const Printer& printer) {
  const auto& most = printer.max_acceleration;
  const PerAxis limits = {most[0], most[1], most[2], printer.motion.extruder_acceleration};
  for (std::size_t axis = 0; axis < limits.size(); ++axis) {
    const double part = std::abs(direction[axis]);
    if (part * acceleration > limits[axis]) acceleration = limits[axis] / part;
  }
  return acceleration;
}

double by_deviation(const Course& before, const Course& after, const Printer& printer) {
  const double both = std::min(before.speed, after.speed);
  const PerAxis in = normalised(before.direction), out = normalised(after.direction);
  double cosine = 0;  // of the turn: 1 straight on, -1 back
  PerAxis change{};
  for (std::size_t axis = 0; axis < in.size(); ++axis) {
    cosine += in[axis] * out[axis];
    change[axis] = out[axis] - in[axis];
  }
  if (cosine < -no_corner) return standing;
  if (cosine > no_corner) return both;
  const double acceleration = axis_limited(normalised(change), after.acceleration, printer);
  const double half = std::sqrt((1 + cosine) / 2);  // cosine of half the turn
  double square = acceleration * printer.motion.junction_deviation * half / (1 - half);
  if (after.length < short_move && cosine > arc_turn) {
    square = std::min(square, acceleration * after.length / std::acos(cosine));
  }
  return std::clamp(std::sqrt(square), std::min(standing, both), both);
}

}  // namespace

double speed_from_rest(const Course& move, const Printer& printer) {
  if (printer.motion.junction_deviation > 0) return std::min(standing, move.speed);
  const PerAxis jerk = jerks(printer);
  double speed = move.speed;
  for (std::size_t axis = 0; axis < jerk.size(); ++axis) {
    const double part = std::abs(move.direction[axis]);
    if (part * speed > jerk[axis]) speed = jerk[axis] / part;
  }
  return speed;
}

double junction_speed(const Course& before, const Course& after, const Printer& printer) {
  return printer.motion.junction_deviation > 0 ? by_deviation(before, after, printer)
                                               : by_jerk(before, after, printer);
}

double speed_after(double speed, double acceleration, double length) {
  return std::sqrt(speed * speed + 2 * acceleration * length);
}

}  // namespace unicursal::gcode
