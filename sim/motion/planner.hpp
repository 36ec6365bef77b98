// The firmware's queue of planned moves: 16 blocks, of which 15 can be used; look-ahead over them; and their
// execution in time. It behaves like Marlin 2.1 (sim/README.md, "Marlin 2.1": motion).
//
// Positions arrive as absolute steps, so rounding errors do not accumulate. A block and its trapezoid are
// fixed when the block starts; until then each block added behind it may raise its exit speed. The first
// block after a standstill waits 0.1 s, or until three blocks are queued, so that look-ahead has something to
// work on. While few blocks wait, a move under 20 ms is stretched towards that time.
//
// The planner has no clock: its owner advances time, in steps of any size; the result is the same.
//
//   planner.push(move, now);                  // has_room()
//   planner.advance_to(*planner.next_event());
//
// mm, mm/s, mm/s², printer seconds.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>

#include "sim/motion/feeder_split.hpp"
#include "sim/motion/junction.hpp"
#include "sim/motion/move.hpp"
#include "sim/motion/trapezoid.hpp"

namespace unicursal::sim {

struct MotionLimits {
  PerAxis<double> steps_per_mm{80, 80, 400, 400};
  PerAxis<double> max_speed{150, 150, 10, 50};
  PerAxis<double> max_acceleration{1500, 1500, 100, 10000};
  PerAxis<double> jerk{10, 10, 0.3, 5};  ///< Classic jerk, mm/s.
  double print_acceleration = 3000;      ///< Along a move that extrudes.
  double retract_acceleration = 3000;    ///< Moves of E alone.
  double travel_acceleration = 3000;
  double junction_deviation = 0;  ///< mm; 0 = classic jerk.
  double step_rate = 0;           ///< Limit of each axis, steps/s (40 000 on 8-bit boards); 0 = none.
  double least_time = 0.02;       ///< Shortest move while the queue is short, s (M205 B).
};

/// A move to be planned.
struct Move {
  PerAxis<std::int64_t> target{};  ///< Absolute position, steps.
  double filament = 0;             ///< E of the move before rounding to steps, mm.
  double speed = 0;                ///< Speed along the move, mm/s.
  Mix mix;
};

class Planner {
 public:
  static constexpr std::size_t usable_blocks = 15;

  Planner(MotionLimits limits, MoveSink& sink);

  std::size_t free_slots() const { return usable_blocks - blocks_.size(); }
  bool has_room() const { return free_slots() > 0; }
  bool still() const { return blocks_.empty(); }
  /// Blocks that are planned and not yet done, the running one included.
  std::size_t queued() const { return blocks_.size(); }

  /// Plans a move. A move of fewer than six steps is merged into the next one.
  /// Precondition: has_room(); `now` does not decrease from call to call.
  void push(const Move& move, double now);
  /// Carries out everything that is done by `now`.
  void advance_to(double now);
  /// The time at which the oldest block ends; nullopt if no block is queued or the planner is stuck.
  std::optional<double> next_event() const;
  /// A command asks for the next stop, so an empty queue is not a starvation.
  void stop_is_meant() { stop_meant_ = true; }
  /// Whether the firmware hangs: its stepper interrupt loops for ever over a mixture of zeros.
  bool stuck() const { return stuck_; }

  /// Stops at once: the running move ends where it is, and the others are dropped.
  void abort(double now);
  /// Board reset: like abort(), and a planner that is stuck runs again.
  void reset(double now);
  /// Sets another mixture for everything that is still to be done, the rest of the running move included, as
  /// in firmwares whose mixture is not part of a move.
  void remix(const Mix& mix, double now);
  /// Sets the position without moving. Precondition: still(), or only E is changed.
  void set_position(const PerAxis<std::int64_t>& steps);

  /// The end of the queue, steps.
  const PerAxis<std::int64_t>& planned_position() const { return planned_; }
  /// The end of the last finished move, steps.
  const PerAxis<std::int64_t>& executed_position() const { return executed_; }
  const PerFeeder<std::int64_t>& feeder_steps() const { return feeder_steps_; }
  MotionLimits& limits() { return limits_; }
  const MotionLimits& limits() const { return limits_; }

 private:
  struct Block {
    PerAxis<std::int64_t> steps{};
    double filament = 0;
    PerAxis<double> direction{};  ///< Distance of each axis for 1 mm along the move.
    Trapezoid speed;
    double max_entry = 0;
    Mix mix;
    double reported = 0;     ///< The part that the sink already knows, 0…1.
    double reported_at = 0;  ///< The time at which that part was done.
    double start = 0;        ///< Earliest start; fixed once the block has started.
    bool started = false;
    bool after_meant_stop = false;
    bool alone =
        false;  ///< Whether no block was queued behind it when it started, so that it ends at a stop.

    /// The part that is done by `now`, 0…1.
    double done_by(double now) const { return speed.distance(now - start) / speed.length; }
    MoveShape shape() const { return {direction, speed.nominal, speed.length}; }
  };

  Block make_block(const PerAxis<std::int64_t>& steps, const Move& move) const;
  double nominal_speed(const Block& block, double asked) const;
  double acceleration_for(const Block& block) const;
  double stretched_speed(double length, double speed) const;
  double junction_speed(const Block& before, const Block& after) const;
  double first_speed(const Block& block) const;
  void enqueue(Block block, double now);
  void look_ahead();
  void start_first();
  void note_stop(const Block& block);
  void report(Block& block, double done, double now);
  Position place() const;

  MotionLimits limits_;
  MoveSink& sink_;
  std::deque<Block> blocks_;
  FeederSplit split_;
  PerAxis<std::int64_t> planned_{}, executed_{};
  PerFeeder<std::int64_t> feeder_steps_{};
  double put_off_ = 0;  ///< Filament of short moves that wait for the next one, mm.
  double last_end_ = 0;
  bool last_laid_ = false;   ///< Whether the last finished move laid a bead.
  bool last_alone_ = false;  ///< Whether it stopped because no next move was queued.
  bool stop_meant_ = false;
  bool stuck_ = false;
};

}  // namespace unicursal::sim
