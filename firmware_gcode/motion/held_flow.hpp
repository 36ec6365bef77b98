// The flow that a curve can sustain. Hairpins slow the nozzle down, the more the faster it approaches them,
// and the flow falls with the speed. So the sustainable flow is a property of the curve and of the firmware's
// corner speeds (motion/time_estimate.hpp).
#pragma once

#include <vector>

#include "firmware_gcode/print/print_settings.hpp"
#include "firmware_gcode/print/printer.hpp"

namespace unicursal::gcode {

/// A flow is sustained if, in this fraction of the seconds, it falls short by no more than the tolerance.
inline constexpr double held_share = 0.95;
inline constexpr double flow_tolerance = 0.05;

/// Returns the highest flow that the fill of these layers sustains, mm³/s, rounded down to 0.01, and at most
/// the printer's max_flow (also for layers without beads). Assumes the layer height of the settings for all
/// layers.
double held_flow(const std::vector<PlacedLayer>& layers, const PrintSettings& settings,
                 const Printer& printer);

/// The fraction of the seconds in which `flow` is sustained.
double share_held(const std::vector<PlacedLayer>& layers, PrintSettings settings, const Printer& printer,
                  double flow);

}  // namespace unicursal::gcode
