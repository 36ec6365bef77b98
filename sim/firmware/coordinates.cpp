#include "sim/firmware/coordinates.hpp"

#include <algorithm>

namespace unicursal::sim {

namespace {

constexpr std::array<char, 3> letters{'X', 'Y', 'Z'};
constexpr double seconds_per_minute = 60;

// Limits far beyond any machine, so that hostile moves neither overflow nor take years. mm
constexpr double farthest_place = 1e4, farthest_e = 1e7;

double bounded(double mm, double farthest) {
  return std::clamp(mm, -farthest, farthest);
}

}  // namespace

MoveTarget Coordinates::target(const Command& command) {
  MoveTarget target{place_, e_, 0, false};
  for (std::size_t i = 0; i < letters.size(); ++i) {
    if (const auto value = command.value(letters[i])) {
      target.place[i] = bounded(*value * unit_ + (absolute_ ? origin_[i] : place_[i]), farthest_place);
    }
    const double inside = std::clamp(target.place[i], least_[i], bed_[i]);
    if (!homed_[i] || inside == target.place[i]) continue;
    target.place[i] = inside;
    target.held_at_edge = true;
  }
  if (const auto value = command.value('E'))
    target.e = bounded(*value * unit_ + (absolute_e_ ? 0 : e_), farthest_e);
  if (const auto value = command.value('F'); value && *value > 0) {
    speed_ = *value * unit_ / seconds_per_minute;
  }
  target.speed = speed_ * feed_;
  return target;
}

void Coordinates::arrive(const MoveTarget& target) {
  place_ = target.place;
  e_ = target.e;
}

void Coordinates::shift_origin(const Command& command) {
  for (std::size_t i = 0; i < letters.size(); ++i) {
    if (const auto value = command.value(letters[i])) origin_[i] = place_[i] - *value * unit_;
  }
  if (const auto value = command.value('E')) e_ = *value * unit_;
}

void Coordinates::home(Axis axis) {
  place_[axis] = origin_[axis] = 0;
  homed_[axis] = true;
}

void Coordinates::stopped_at(const std::array<double, 3>& place, double e) {
  place_ = place;
  e_ = e;
}

double Coordinates::limited(double percent) {
  return std::clamp(percent, 1.0, 999.0) / 100;
}

}  // namespace unicursal::sim
