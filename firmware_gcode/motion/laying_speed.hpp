// The speed at which beads are laid. Paper §4.2: the feeders turn at a constant rate, and the speed of each
// segment is flow ÷ (bead width × layer height). For comparison (its Figure 21), the nozzle can run at a
// constant speed instead, and the feeders follow. In both cases E is the segment's own volume, so that no
// speed limit changes what is laid. mm, mm/s, mm³, mm³/s.
//
// A segment that is thinner than the nozzle can lay runs only as fast as the thinnest bead, at less flow. A
// segment that is wider than the nozzle can lay keeps the flow: neither slowing down nor speeding up would
// help.
//
// An automatic flow is the highest that all layers of the route's window sustain when the print begins. A
// later layer whose hairpins cannot sustain it is printed at the highest flow that it can sustain; the next
// one returns to the flow of the print.
#pragma once

#include <vector>

#include "firmware_gcode/print/print_settings.hpp"
#include "firmware_gcode/print/printer.hpp"

namespace unicursal::gcode {

class LayingSpeed {
 public:
  LayingSpeed(const Printer& printer, const PrintSettings& settings);

  /// The flow is not chosen yet: settle() must be called before the first speed().
  bool open() const { return open_; }
  /// Chooses the flow: the lowest of those that the known layers sustain.
  void settle(const std::vector<PlacedLayer>& layers);

  /// The flow of the print.
  double flow() const { return flow_; }
  /// The flow of one layer: lower if the flow is automatic and the layer cannot sustain that of the print.
  double flow_of(const PlacedLayer& layer) const;
  /// Sets the flow of the beads that follow.
  void run_at(double flow) { layer_flow_ = flow; }
  /// The speed of a bead of `volume`. Precondition: the displacement is not zero.
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
