// How long moves take: the firmware's own look-ahead planner, reckoned ahead. Speeds run as trapezoids; a
// move ends as fast as the next one may begin, and as the moves that the firmware knows of by then let it
// brake. A move is fixed when it starts; at that moment `planned_moves` of them are known, itself included.
// mm, mm/s, mm/s², s.
//
// Taken for granted: the printer's queue is always full. So what a firmware does when it runs low (short
// moves are stretched) is left out, and so are whole motor steps. The seconds of heating and homing are not
// here; nor are those of commands in between, but that some end all motion: stop().
#pragma once

#include <cstddef>
#include <deque>
#include <functional>

#include "firmware_gcode/motion/junction.hpp"
#include "firmware_gcode/print/printer.hpp"

namespace unicursal::gcode {

class TimeEstimate {
 public:
  /// Told of every move when it is fixed, in order: its seconds, and the volume or whatever else it carries.
  using Watch = std::function<void(double seconds, double load)>;

  /// Precondition: a checked printer (checks.hpp).
  explicit TimeEstimate(const Printer& printer, Watch watch = nullptr);

  /// The machine goes by so much, at `speed` if it can. A displacement of zero is no move.
  /// `speed` is along x, y and z, or of the filament if nothing else moves. Precondition: it is positive.
  void move(const PerAxis& displacement, double speed, double load = 0);
  /// All motion ends before what follows.
  void stop();

  /// Of all moves so far; as long as more may follow, the last ones are taken to end at a stand-still.
  double seconds() const;

 private:
  struct Block : Course {
    double most_entry = 0;  ///< what the junction allows
    double entry = 0, exit = 0;
    double load = 0;

    double seconds() const;
  };

  Course course(const PerAxis& displacement, double speed) const;
  void look_ahead();
  void fix_first();

  Printer printer_;
  Watch watch_;
  std::deque<Block> blocks_;  ///< planned and not yet fixed
  double entry_ = 0;          ///< of the first of them, if something runs before it
  bool runs_ = false;         ///< something does
  double fixed_ = 0;          ///< s
};

}  // namespace unicursal::gcode
