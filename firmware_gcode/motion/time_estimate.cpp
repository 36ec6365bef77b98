#include "firmware_gcode/motion/time_estimate.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace unicursal::gcode {
namespace {

/// Moves that Marlin knows when one starts: its queue has 15 usable places, one of which has just been freed.
constexpr std::size_t planned_moves = 14;
constexpr double standing = 0.05;  ///< mm/s at which the last of the planned moves ends

}  // namespace

double TimeEstimate::Block::seconds() const {
  // The speed where the ramp up from the entry meets the ramp down to the exit, limited by the nominal speed.
  const double meeting = std::sqrt((entry * entry + exit * exit) / 2 + acceleration * length);
  const double top = std::max({std::min(speed, meeting), entry, exit});
  const double ramps = (2 * top * top - entry * entry - exit * exit) / (2 * acceleration);
  return (2 * top - entry - exit) / acceleration + std::max(0.0, length - ramps) / top;
}

TimeEstimate::TimeEstimate(const Printer& printer, Watch watch)
    : printer_(printer), watch_(std::move(watch)) {}

Course TimeEstimate::course(const PerAxis& displacement, double speed) const {
  const auto& [x, y, z, e] = displacement;
  const Motion& m = printer_.motion;
  const auto& most_speed = printer_.max_speed;
  const auto& most = printer_.max_acceleration;
  const PerAxis speeds = {most_speed[0], most_speed[1], most_speed[2], m.extruder_speed};
  const PerAxis accelerations = {most[0], most[1], most[2], m.extruder_acceleration};
  const double way = std::hypot(x, y, z);
  Course result;
  result.length = way > 0 ? way : std::abs(e);
  result.speed = std::max(speed, standing);
  result.acceleration = e == 0 ? m.travel_acceleration : way > 0 ? m.acceleration : m.retract_acceleration;
  for (std::size_t axis = 0; axis < displacement.size(); ++axis) {
    result.direction[axis] = displacement[axis] / result.length;
    const double part = std::abs(result.direction[axis]);
    if (part * result.speed > speeds[axis]) result.speed = speeds[axis] / part;
    if (part * result.acceleration > accelerations[axis]) result.acceleration = accelerations[axis] / part;
  }
  return result;
}

void TimeEstimate::move(const PerAxis& displacement, double speed, double load) {
  assert(speed > 0);
  if (std::all_of(displacement.begin(), displacement.end(), [](double d) { return d == 0; })) return;
  Block block{course(displacement, speed)};
  block.load = load;
  block.most_entry =
      blocks_.empty() ? speed_from_rest(block, printer_) : junction_speed(blocks_.back(), block, printer_);
  blocks_.push_back(block);
  if (blocks_.size() <= planned_moves) return;
  // The latest move is not known yet when the first one starts.
  const Block last = blocks_.back();
  blocks_.pop_back();
  look_ahead();
  fix_first();
  blocks_.push_back(last);
}

/// The backward pass limits every entry speed by the braking distance, the forward pass by the acceleration.
void TimeEstimate::look_ahead() {
  double exit = std::min(standing, blocks_.back().speed);
  for (auto block = blocks_.rbegin(); block != blocks_.rend(); ++block) {
    block->exit = exit;
    block->entry = std::min(block->most_entry, speed_after(exit, block->acceleration, block->length));
    exit = block->entry;
  }
  double entry = runs_ ? entry_ : blocks_.front().entry;
  for (Block& block : blocks_) {
    block.entry = entry;
    block.exit = std::min(block.exit, speed_after(entry, block.acceleration, block.length));
    entry = block.exit;
  }
}

void TimeEstimate::fix_first() {
  const Block& first = blocks_.front();
  const double seconds = first.seconds();
  fixed_ += seconds;
  if (watch_) watch_(seconds, first.load);
  entry_ = first.exit;
  runs_ = true;
  blocks_.pop_front();
}

void TimeEstimate::stop() {
  while (!blocks_.empty()) {
    look_ahead();
    fix_first();
  }
  runs_ = false;
}

double TimeEstimate::seconds() const {
  if (blocks_.empty()) return fixed_;
  TimeEstimate rest = *this;
  rest.watch_ = nullptr;
  rest.stop();
  return rest.fixed_;
}

}  // namespace unicursal::gcode
