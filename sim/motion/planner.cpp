#include "sim/motion/planner.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace unicursal::sim {

namespace {

constexpr double slowest = 0.05;           // mm/s: exit speed of a move without a successor
constexpr std::int64_t fewest_steps = 6;   // a move with fewer joins the next one
constexpr double first_block_delay = 0.1;  // s that a first block waits for others
constexpr std::size_t company = 3;         // number of blocks with which it waits no longer
constexpr std::size_t short_queue_from = 2, short_queue_to = 7;  // waiting blocks: the queue counts as short

bool extrudes_along(const PerAxis<std::int64_t>& steps) {
  return steps[axis_e] > 0 && (steps[axis_x] != 0 || steps[axis_y] != 0);
}

}  // namespace

Planner::Planner(MotionLimits limits, MoveSink& sink) : limits_(limits), sink_(sink) {}

void Planner::push(const Move& move, double now) {
  assert(has_room());
  advance_to(now);
  PerAxis<std::int64_t> steps{};
  std::int64_t most = 0;
  for (std::size_t i = 0; i < axes; ++i) {
    steps[i] = move.target[i] - planned_[i];
    most = std::max(most, std::abs(steps[i]));
  }
  put_off_ += move.filament;
  if (most < fewest_steps) return;
  planned_ = move.target;
  Block block = make_block(steps, move);
  block.filament = std::exchange(put_off_, 0);
  block.after_meant_stop = std::exchange(stop_meant_, false);
  enqueue(block, now);
}

void Planner::enqueue(Block block, double now) {
  block.max_entry = blocks_.empty() ? first_speed(block) : junction_speed(blocks_.back(), block);
  if (blocks_.empty()) block.start = std::max(now, last_end_) + first_block_delay;
  blocks_.push_back(block);
  if (!blocks_.front().started && blocks_.size() >= company) {
    blocks_.front().start = std::min(blocks_.front().start, now);
  }
  look_ahead();
  sink_.queue_changed(now, blocks_.size());
}

Planner::Block Planner::make_block(const PerAxis<std::int64_t>& steps, const Move& move) const {
  Block block;
  block.steps = steps;
  block.mix = move.mix;
  PerAxis<double> mm{};
  for (std::size_t i = 0; i < axes; ++i) mm[i] = static_cast<double>(steps[i]) / limits_.steps_per_mm[i];
  const double way = std::hypot(mm[axis_x], mm[axis_y], mm[axis_z]);
  const double length = way > 0 ? way : std::abs(mm[axis_e]);
  for (std::size_t i = 0; i < axes; ++i) block.direction[i] = mm[i] / length;
  block.speed.length = length;
  block.speed.nominal = nominal_speed(block, move.speed);
  block.speed.entry = block.speed.exit = block.speed.nominal;
  block.speed.acceleration = acceleration_for(block);
  return block;
}

double Planner::nominal_speed(const Block& block, double asked) const {
  double nominal = stretched_speed(block.speed.length, std::max(asked, slowest));
  for (std::size_t i = 0; i < axes; ++i) {
    const double part = std::abs(block.direction[i]);
    if (part == 0) continue;
    nominal = std::min(nominal, limits_.max_speed[i] / part);
    if (limits_.step_rate > 0) {
      nominal = std::min(nominal, limits_.step_rate / (part * limits_.steps_per_mm[i]));
    }
  }
  return nominal;
}

double Planner::acceleration_for(const Block& block) const {
  const auto moves = [&](Axis axis) { return block.steps[axis] != 0; };
  double acceleration = limits_.print_acceleration;
  if (!moves(axis_e)) acceleration = limits_.travel_acceleration;
  if (!moves(axis_x) && !moves(axis_y) && !moves(axis_z)) acceleration = limits_.retract_acceleration;
  for (std::size_t i = 0; i < axes; ++i) {
    if (block.steps[i] == 0) continue;
    acceleration = std::min(acceleration, limits_.max_acceleration[i] / std::abs(block.direction[i]));
  }
  return acceleration;
}

double Planner::stretched_speed(double length, double speed) const {
  const std::size_t waiting = blocks_.size() - (!blocks_.empty() && blocks_.front().started ? 1 : 0);
  const double time = length / speed;
  if (waiting < short_queue_from || waiting > short_queue_to || time >= limits_.least_time) return speed;
  return length / (time + 2 * (limits_.least_time - time) / static_cast<double>(waiting));
}

double Planner::junction_speed(const Block& before, const Block& after) const {
  if (limits_.junction_deviation <= 0) return jerk_speed(before.shape(), after.shape(), limits_.jerk);
  return std::max(slowest, deviation_speed(before.shape(), after.shape(), limits_.junction_deviation,
                                           limits_.max_acceleration, after.speed.acceleration));
}

double Planner::first_speed(const Block& block) const {
  return limits_.junction_deviation > 0 ? slowest : speed_from_rest(block.shape(), limits_.jerk);
}

// The backward pass limits each entry speed to what the block can still brake from; the forward pass limits
// each exit speed to what the block can reach. A running block is fixed, and so is the entry of the next one.
void Planner::look_ahead() {
  double exit = std::min(slowest, blocks_.back().speed.nominal);
  for (auto block = blocks_.rbegin(); block != blocks_.rend() && !block->started; ++block) {
    Trapezoid& speed = block->speed;
    speed.exit = exit;
    speed.entry = std::min(block->max_entry, reachable_speed(exit, speed.acceleration, speed.length));
    exit = speed.entry;
  }
  double entry = blocks_.front().started ? blocks_.front().speed.exit : blocks_.front().speed.entry;
  for (Block& block : blocks_) {
    if (block.started) continue;
    Trapezoid& speed = block.speed;
    speed.entry = entry;
    speed.exit = std::min(speed.exit, reachable_speed(entry, speed.acceleration, speed.length));
    entry = speed.exit;
  }
}

std::optional<double> Planner::next_event() const {
  if (blocks_.empty() || stuck_) return std::nullopt;
  return blocks_.front().start + blocks_.front().speed.seconds();
}

void Planner::advance_to(double now) {
  while (!blocks_.empty() && !stuck_ && blocks_.front().start <= now) {
    start_first();
    Block& block = blocks_.front();
    const double end = block.start + block.speed.seconds();
    if (stuck_ || end > now) return;
    report(block, 1, end);
    last_end_ = end;
    last_alone_ = block.alone;
    blocks_.pop_front();
    sink_.queue_changed(end, blocks_.size());
    if (!blocks_.empty()) blocks_.front().start = end;
  }
}

void Planner::start_first() {
  Block& block = blocks_.front();
  if (block.started) return;
  block.started = true;
  block.alone = blocks_.size() == 1;
  note_stop(block);
  const Factors& factors = block.mix.factors;
  const bool nothing = std::all_of(factors.begin(), factors.end(), [](auto f) { return f == 0; });
  stuck_ = nothing && block.steps[axis_e] != 0;
}

void Planner::note_stop(const Block& block) {
  if (!last_alone_ || !last_laid_ || block.after_meant_stop || !extrudes_along(block.steps)) return;
  const double seconds = block.start - last_end_;
  sink_.starved({last_end_, place(), seconds, seconds > 0});
}

Position Planner::place() const {
  const auto mm = [this](Axis i) { return static_cast<double>(executed_[i]) / limits_.steps_per_mm[i]; };
  return {mm(axis_x), mm(axis_y), mm(axis_z)};
}

/// The part `done` of the block (0…1) has been carried out by `now`: passes what is new of it to the sink.
void Planner::report(Block& block, double done, double now) {
  if (done <= block.reported) return;
  const auto part_of = [](std::int64_t steps, double share) {
    return static_cast<std::int64_t>(std::trunc(static_cast<double>(steps) * share));
  };
  ExecutedMove move;
  move.from = place();
  PerAxis<std::int64_t> steps{};
  for (std::size_t i = 0; i < axes; ++i) {
    steps[i] = part_of(block.steps[i], done) - part_of(block.steps[i], block.reported);
    executed_[i] += steps[i];
  }
  move.to = place();
  move.mix = block.mix;
  move.filament = block.filament * (done - block.reported);
  if (steps[axis_e] != 0) move.feeder_steps = split_.split(steps[axis_e], block.mix.factors);
  for (std::size_t i = 0; i < max_feeders; ++i) feeder_steps_[i] += move.feeder_steps[i];
  move.start = block.reported > 0 ? block.reported_at : block.start;
  move.end = now;
  const bool whole = block.reported == 0 && done == 1;
  move.speed = whole ? block.speed : block.speed.part(move.start - block.start, now - block.start);
  block.reported = done;
  block.reported_at = now;
  last_laid_ = lays_bead(move);
  sink_.moved(move);
}

void Planner::abort(double now) {
  advance_to(now);
  if (!blocks_.empty() && blocks_.front().started && !stuck_) {
    Block& block = blocks_.front();
    report(block, block.done_by(now), now);
  }
  if (!blocks_.empty()) sink_.queue_changed(now, 0);
  blocks_.clear();
  put_off_ = 0;
  planned_ = executed_;
  last_end_ = now;
  stop_meant_ = true;
}

void Planner::reset(double now) {
  abort(now);
  stuck_ = false;
}

void Planner::remix(const Mix& mix, double now) {
  advance_to(now);
  if (stuck_) return;
  for (Block& block : blocks_) {
    if (block.started) report(block, block.done_by(now), now);
    block.mix = mix;
  }
}

void Planner::set_position(const PerAxis<std::int64_t>& steps) {
  for (std::size_t i = 0; i < axes; ++i) {
    executed_[i] += steps[i] - planned_[i];
    planned_[i] = steps[i];
  }
}

}  // namespace unicursal::sim
