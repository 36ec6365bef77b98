// The factors of speed and flow that a file sets for itself (M220, M221). They are applied to its moves
// instead of being sent, so that those that a person sets during the print stay in force, and the volumes by
// which mixtures are switched are those that come out. Source: Marlin's documentation of M220, whose B keeps
// the speed and whose R fetches it again, and of M221.
#pragma once

#include "firmware_gcode/sliced/words.hpp"

namespace unicursal::gcode {

class Rates {
 public:
  /// Takes an M220 or M221; returns false if its per cent are not between 1 and 999.
  bool take(const SlicedCommand& command);

  double speed() const { return speed_; }  ///< 1: as the file's F says
  double flow() const { return flow_; }    ///< 1: as the file's E says

 private:
  double speed_ = 1, flow_ = 1, kept_ = 1;
};

}  // namespace unicursal::gcode
