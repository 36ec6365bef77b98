// How fast beads are laid. Paper §4.2: the feeders turn at a constant rate, and the speed of each segment is
// flow ÷ (bead width × layer height); or, for comparison (its Figure 21), the nozzle runs at a constant speed
// and the feeders follow. Either way E is the segment's own volume, so that nothing a limit does to the speed
// changes what is laid. mm, mm/s, mm³, mm³/s.
//
// A segment thinner than the nozzle can lay runs no faster than the thinnest bead would, at less flow. (One
// that is wider than the nozzle can lay keeps the flow: to slow down is no way out, to speed up is none
// either.)
//
// An automatic flow is the highest that every layer of the route's window holds when the print begins. A
// layer that comes later and holds less, since its hairpins are tighter or closer together, is laid with what
// it holds; the next one goes back to the flow of the print.
#pragma once

#include <vector>

#include "firmware_gcode/print/print_settings.hpp"
#include "firmware_gcode/print/printer.hpp"

namespace unicursal::gcode {

class LayingSpeed {
 public:
  LayingSpeed(const Printer& printer, const PrintSettings& settings);

  /// The flow is still to be chosen: settle() comes before the first speed().
  bool open() const { return open_; }
  /// Chooses the flow by the layers that are known: the least of what they hold.
  void settle(const std::vector<PlacedLayer>& layers);

  /// Of the print.
  double flow() const { return flow_; }
  /// Of one layer: less where it cannot hold that of the print, if it is automatic.
  double flow_of(const PlacedLayer& layer) const;
  /// What follows is laid with this flow.
  void run_at(double flow) { layer_flow_ = flow; }
  /// Of a bead of `volume`. Precondition: the displacement is not zero.
  double speed(const core::Vec2& displacement, double volume, std::size_t layer, double layer_height) const;

 private:
  Printer printer_;
  PrintSettings settings_;
  double flow_;
  double layer_flow_;
  bool automatic_;
  bool open_;
};

}  // namespace unicursal::gcode
