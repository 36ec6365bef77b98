// How fast beads are laid. Paper §4.2: the feeders turn at a constant rate, and the speed of each segment is
// flow ÷ (bead width × layer height); or, for comparison (its Figure 21), the nozzle runs at a constant speed
// and the feeders follow. Either way E is the segment's own volume, so that nothing a limit does to the speed
// changes what is laid. mm, mm/s, mm³, mm³/s.
//
// A segment thinner than the nozzle can lay runs no faster than the thinnest bead would, at less flow. (One
// that is wider than the nozzle can lay keeps the flow: to slow down is no way out, to speed up is none
// either.)
#pragma once

#include <vector>

#include "firmware_gcode/toolpath/encoder.hpp"

namespace unicursal::gcode {

class Pace {
 public:
  Pace(const Printer& printer, const PrintSettings& settings);

  /// The flow is still to be chosen: settle() comes before the first speed().
  bool open() const { return open_; }
  /// Chooses the flow by the layers that are known.
  void settle(const std::vector<PlacedLayer>& layers);

  double flow() const { return flow_; }
  /// Of a bead of `volume`. Precondition: the displacement is not zero.
  double speed(const core::Vec2& displacement, double volume, std::size_t layer, double layer_height) const;

 private:
  Printer printer_;
  PrintSettings settings_;
  double flow_;
  bool open_;
};

}  // namespace unicursal::gcode
