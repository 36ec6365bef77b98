#include "sim/motion/junction.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace unicursal::sim {

namespace {

/// Part of the corner's speed from which a start from rest replaces it.
constexpr double hardly_faster = 0.99;
constexpr double straight = 0.999999;     // cosines beyond this mean a straight line, or a complete reversal
constexpr double short_move = 1;          // mm
constexpr double slight_turn = -0.70711;  // cosine between the way back and the way on: a turn of 45°

using Direction = PerAxis<double>;

double dot(const Direction& a, const Direction& b) {
  double sum = 0;
  for (std::size_t i = 0; i < axes; ++i) sum += a[i] * b[i];
  return sum;
}

Direction unit(const Direction& d) {
  const double length = std::sqrt(dot(d, d));
  Direction result{};
  for (std::size_t i = 0; i < axes && length > 0; ++i) result[i] = d[i] / length;
  return result;
}

double jump(double before, double after) {
  return before * after < 0 ? std::max(std::abs(before), std::abs(after)) : std::abs(after - before);
}

/// Limits `acceleration` along `direction` so that no axis exceeds its own limit.
double within(const PerAxis<double>& limits, const Direction& direction, double acceleration) {
  for (std::size_t i = 0; i < axes; ++i) {
    if (direction[i] != 0) acceleration = std::min(acceleration, limits[i] / std::abs(direction[i]));
  }
  return acceleration;
}

}  // namespace

double speed_from_rest(const MoveShape& move, const PerAxis<double>& jerk) {
  double speed = move.nominal;
  for (std::size_t i = 0; i < axes; ++i) {
    if (move.direction[i] != 0) speed = std::min(speed, jerk[i] / std::abs(move.direction[i]));
  }
  return speed;
}

double jerk_speed(const MoveShape& before, const MoveShape& after, const PerAxis<double>& jerk) {
  double speed = std::min(before.nominal, after.nominal);
  for (std::size_t i = 0; i < axes; ++i) {
    const double change = jump(before.direction[i], after.direction[i]);
    if (change > 0) speed = std::min(speed, jerk[i] / change);
  }
  const double rest = speed_from_rest(after, jerk);
  const bool both_faster = std::min(rest, speed_from_rest(before, jerk)) > speed * hardly_faster;
  return both_faster ? std::min({rest, before.nominal, after.nominal}) : speed;
}

double deviation_speed(const MoveShape& before, const MoveShape& after, double deviation,
                       const PerAxis<double>& max_acceleration, double acceleration) {
  const double nominal = std::min(before.nominal, after.nominal);
  const Direction from = unit(before.direction), to = unit(after.direction);
  const double cosine = -dot(from, to);
  if (cosine > straight) return 0;
  if (cosine < -straight) return nominal;
  Direction change{};
  for (std::size_t i = 0; i < axes; ++i) change[i] = to[i] - from[i];
  const double limit = within(max_acceleration, unit(change), acceleration);
  const double half_sine = std::sqrt((1 - cosine) / 2);
  double square = limit * deviation * half_sine / (1 - half_sine);
  if (after.length < short_move && cosine < slight_turn) {
    square = std::min(square, after.length * limit / (std::numbers::pi - std::acos(cosine)));
  }
  return std::min(nominal, std::sqrt(square));
}

}  // namespace unicursal::sim
