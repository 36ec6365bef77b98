// The firmware's queue of planned moves: 16 blocks of which 15 can be used, look-ahead over them, and the
// moves' own time. Behaviour of Marlin 2.1 (firmware facts, motion defaults).
//
// Positions arrive as absolute steps, so rounding never adds up. A block is fixed (its trapezoid with it)
// when it starts; until then every block added behind it may raise its exit speed. The first block after a
// stand-still waits 0.1 s, or until three are queued, so that look-ahead has something to look at. While few
// blocks wait, a move of under 20 ms is stretched towards that time.
//
// The planner has no clock: whoever holds it says how far time goes, in any steps; the result is the same.
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
  PerAxis<double> jerk{10, 10, 0.3, 5};  ///< mm/s that an axis may jump by
  double print_acceleration = 3000;      ///< along a move that extrudes
  double retract_acceleration = 3000;    ///< E alone
  double travel_acceleration = 3000;
  double junction_deviation = 0;  ///< mm; 0: classic jerk
  double step_rate = 0;           ///< steps/s that the board can give one axis (40 000 on 8 bits); 0: any
  double least_time = 0.02;       ///< s of a move while the queue is short (M205 B)
};

/// A move to be planned.
struct Move {
  PerAxis<std::int64_t> target{};  ///< steps, absolute
  double filament = 0;             ///< mm, its E before rounding to steps
  double speed = 0;                ///< mm/s along it
  Mix mix;
};

class Planner {
 public:
  static constexpr std::size_t usable_blocks = 15;

  Planner(MotionLimits limits, MoveSink& sink);

  std::size_t free_slots() const { return usable_blocks - blocks_.size(); }
  bool has_room() const { return free_slots() > 0; }
  bool still() const { return blocks_.empty(); }
  /// Blocks planned and not yet done, the running one included.
  std::size_t queued() const { return blocks_.size(); }

  /// Plans a move. One of fewer than six steps is put off: it joins the next one.
  /// Precondition: has_room(), `now` not before that of any earlier call.
  void push(const Move& move, double now);
  /// Carries out everything that is done by `now`.
  void advance_to(double now);
  /// When the planner's state next changes if nothing is added: the oldest block ends, a slot frees, with the
  /// last block the queue is dry. Nothing when all is still or stuck.
  std::optional<double> next_event() const;
  /// The stop to come is asked for by a command: a queue that is dry then is no starvation.
  void stop_is_meant() { stop_meant_ = true; }
  /// The stepper interrupt turns for ever over a mixture of zeros.
  bool stuck() const { return stuck_; }

  /// Stops at once: the running move ends where it is, the others never happen.
  void abort(double now);
  /// The same, and a mixture of zeros is forgotten: the board has been reset.
  void reset(double now);
  /// Another mixture for everything that is still to be done, the rest of the running move included, as in
  /// firmwares whose mixture is not part of a move.
  void remix(const Mix& mix, double now);
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
    double told = 0;     ///< the part that the sink knows of already
    double told_at = 0;  ///< when that was done
    double start = 0;    ///< when it may start; fixed once it has
    bool started = false;
    bool after_meant_stop = false;
    bool alone = false;  ///< nothing was queued behind it when it started, so it ends at a stand

    /// The part of it that is done by `now`, 0…1.
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
  void tell(Block& block, double done, double now);
  Position place() const;

  MotionLimits limits_;
  MoveSink& sink_;
  std::deque<Block> blocks_;
  FeederSplit split_;
  PerAxis<std::int64_t> planned_{}, executed_{};
  PerFeeder<std::int64_t> feeder_steps_{};
  double put_off_ = 0;  ///< mm of filament of moves that wait for a longer one
  double last_end_ = 0;
  bool last_laid_ = false;   ///< the last finished move laid a bead
  bool last_alone_ = false;  ///< and had come to a stand for want of a next one
  bool stop_meant_ = false;
  bool stuck_ = false;
};

}  // namespace unicursal::sim
