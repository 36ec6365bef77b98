// The review of every chunk before it is handed out: its lines are read back, checked and timed.
#pragma once

#include <string>

#include "firmware_gcode/motion/time_estimate.hpp"
#include "firmware_gcode/review/line_check.hpp"

namespace unicursal::gcode {

class Review {
 public:
  Review(const Printer& printer, const Dialect& dialect);

  /// Sets the chunk's seconds. Messages begin with `place`, such as "layer 3". Throws core::DataError for
  /// lines that must not reach a printer, and then keeps its state.
  void operator()(Chunk& chunk, const std::string& place);

  /// The time from the start of the first bead to the end of the last one so far, s.
  double laying_seconds() const;

 private:
  LineCheck check_;
  TimeEstimate time_;
  double assigned_ = 0;       ///< s that were assigned to chunks so far
  double before_first_ = -1;  ///< s until the first bead; negative if there was none yet
  double last_bead_ = 0;      ///< s until the end of the last bead
};

}  // namespace unicursal::gcode
