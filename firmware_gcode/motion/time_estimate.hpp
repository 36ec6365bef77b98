// Estimates how long moves take by repeating the firmware's own look-ahead planner. Speeds are trapezoids.
// The final speed of a move is limited by the start of the next one and by the braking distance over the
// moves that the firmware knows by then. A move is final when it starts; the firmware then knows
// `planned_moves` moves, including itself. mm, mm/s, mm/s², s.
//
// Assumption: the printer's queue is always full. So the estimate omits that a firmware stretches short moves
// when its queue runs low. It also omits whole motor steps, heating, homing, and the time of other commands,
// except that some commands end all motion: stop().
#pragma once

#include <cstddef>
#include <deque>
#include <functional>

#include "firmware_gcode/motion/junction.hpp"
#include "firmware_gcode/print/printer.hpp"

namespace unicursal::gcode {

class TimeEstimate {
 public:
  /// Called for every move when it is final, in order: its seconds, and the load that was passed with it.
  using Watch = std::function<void(double seconds, double load)>;

  /// Precondition: a checked printer (checks.hpp).
  explicit TimeEstimate(const Printer& printer, Watch watch = nullptr);

  /// Adds a move at `speed`, or slower if its length or the limits do not allow that. A displacement of zero
  /// is ignored. `speed` is along x, y and z, or that of the filament if only filament moves. Precondition:
  /// it is positive.
  void move(const PerAxis& displacement, double speed, double load = 0);
  /// All motion ends before the next move.
  void stop();

  /// The time of all moves so far, assuming that the last one ends at standstill.
  double seconds() const;

 private:
  struct Block : Course {
    double most_entry = 0;  ///< greatest speed at the junction
    double entry = 0, exit = 0;
    double load = 0;

    double seconds() const;
  };

  Course course(const PerAxis& displacement, double speed) const;
  void look_ahead();
  void fix_first();

  Printer printer_;
  Watch watch_;
  std::deque<Block> blocks_;  ///< planned and not yet final
  double entry_ = 0;          ///< speed at the start of the first one, if a move runs before it
  bool runs_ = false;         ///< a move runs before the first one
  double fixed_ = 0;          ///< s of the final moves
};

}  // namespace unicursal::gcode
