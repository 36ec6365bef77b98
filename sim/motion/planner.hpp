// The firmware's queue of planned moves: 16 blocks of which 15 can be used, look-ahead over them, and the
// moves' own time. Behaviour of Marlin 2.1 (firmware facts, motion defaults); departures, for simplicity:
// junctions are always by classic jerk, and a junction's speed is the highest at which no axis jumps by
// more than its jerk (Marlin distinguishes coasting from reversal on each axis).
//
// Positions arrive as absolute steps, so rounding never adds up. A block is fixed (its trapezoid with it)
// when it starts; until then every block added behind it may raise its exit speed. The first block after a
// stand-still waits 0.1 s, or until three are queued, so that look-ahead has something to look at.
// mm, mm/s, mm/s², printer seconds.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>

#include "sim/motion/feeder_split.hpp"
#include "sim/motion/move.hpp"
#include "sim/motion/trapezoid.hpp"

namespace unicursal::sim {

enum Axis : std::size_t { axis_x, axis_y, axis_z, axis_e };
inline constexpr std::size_t axes = 4;
template <class T>
using PerAxis = std::array<T, axes>;  ///< x y z e; e is filament of all feeders together

struct MotionLimits {
  PerAxis<double> steps_per_mm{80, 80, 400, 400};
  PerAxis<double> max_speed{150, 150, 10, 50};
  PerAxis<double> max_acceleration{1500, 1500, 100, 10000};
  PerAxis<double> jerk{10, 10, 0.3, 5};  ///< mm/s that an axis may jump by
  double print_acceleration = 3000;      ///< along a move that extrudes
  double retract_acceleration = 3000;    ///< E alone
  double travel_acceleration = 3000;
};

class Planner {
 public:
  static constexpr std::size_t usable_blocks = 15;

  Planner(MotionLimits limits, MoveSink& sink);

  bool has_room() const { return blocks_.size() < usable_blocks; }
  bool still() const { return blocks_.empty(); }
  /// Blocks planned and not yet done, the running one included.
  std::size_t queued() const { return blocks_.size(); }

  /// Plans a move to `target` (steps) at `speed` along it; `filament` is its E before rounding to steps. A
  /// move of fewer than six steps is put off: it joins the next one. Precondition: has_room(), now not before
  /// that of any earlier call.
  void add(double now, const PerAxis<std::int64_t>& target, double filament, double speed, const Mix& mix);
  /// Carries out everything that is done by `now`.
  void advance(double now);
  /// When the oldest block ends if nothing is added; nothing when all is still or stuck.
  std::optional<double> next_end() const;
  /// The stepper interrupt turns for ever over a mixture of zeros.
  bool stuck() const { return stuck_; }

  /// Stops at once: the running move ends where it is, the others never happen.
  void abort(double now);
  /// Says where the machine is without moving. Precondition: still(), or only E is changed.
  void set_position(const PerAxis<std::int64_t>& steps);

  const PerAxis<std::int64_t>& planned_position() const { return planned_; }  ///< end of the queue, steps
  const PerAxis<std::int64_t>& executed_position() const {
    return executed_;
  }  ///< after the last finished move
  const PerFeeder<std::int64_t>& feeder_steps() const { return feeder_steps_; }
  MotionLimits& limits() { return limits_; }
  const MotionLimits& limits() const { return limits_; }

 private:
  struct Block {
    PerAxis<std::int64_t> steps{};
    double filament = 0;
    PerAxis<double> direction{};  ///< mm of each axis for 1 mm along the move
    Trapezoid speed;
    double max_entry = 0;
    Mix mix;
    double start = 0;  ///< when it may start; fixed once it has
    bool started = false;
  };

  Block make_block(const PerAxis<std::int64_t>& steps, double speed, const Mix& mix) const;
  double acceleration_for(const Block& block) const;
  double stretched_speed(double length, double speed) const;
  double speed_from_rest(const Block& block) const;
  double junction_speed(const Block& before, const Block& after) const;
  void look_ahead();
  void start_first();
  void finish(Block& block, double done);

  MotionLimits limits_;
  MoveSink& sink_;
  std::deque<Block> blocks_;
  FeederSplit split_;
  PerAxis<std::int64_t> planned_{}, executed_{};
  PerFeeder<std::int64_t> feeder_steps_{};
  double put_off_ = 0;  ///< mm of filament of moves that wait for a longer one
  double last_end_ = 0;
  bool stuck_ = false;
};

}  // namespace unicursal::sim
