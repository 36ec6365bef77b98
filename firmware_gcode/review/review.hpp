// What every chunk passes before it is handed out: its lines are read back, checked and timed.
#pragma once

#include <string>

#include "firmware_gcode/motion/time_estimate.hpp"
#include "firmware_gcode/review/line_check.hpp"

namespace unicursal::gcode {

class Review {
 public:
  Review(const Printer& printer, const Dialect& dialect);

  /// Sets the chunk's seconds. `place` begins messages: "layer 3". Throws core::DataError for lines that must
  /// not reach a printer, and is then as it was before.
  void operator()(Chunk& chunk, const std::string& place);

  /// s from the first bead's start to the end of the last one so far.
  double laying_seconds() const;

 private:
  LineCheck check_;
  TimeEstimate time_;
  double told_ = 0;           ///< s of the chunks so far
  double before_first_ = -1;  ///< s until the first bead; negative: there was none yet
  double last_bead_ = 0;      ///< s until the last bead's end
};

}  // namespace unicursal::gcode
