// The flow that a curve lets stay constant. Hairpins slow the nozzle down, the more the faster it comes to
// them, and the flow falls with its speed; so how much flow can really be held is a property of the curve and
// of the firmware's corners (motion/time_estimate.hpp).
#pragma once

#include <vector>

#include "firmware_gcode/print/print_settings.hpp"
#include "firmware_gcode/print/printer.hpp"

namespace unicursal::gcode {

/// How constant is constant: in this share of the seconds the flow falls short by no more than the tolerance.
inline constexpr double held_share = 0.95;
inline constexpr double flow_tolerance = 0.05;

/// mm³/s: the highest flow that is held in the fill of these layers, rounded down to 0.01; never more than
/// the printer's max_flow, which is also the answer where there is nothing to lay. Reckoned for the layer
/// height of the settings, whatever that of the layers.
double held_flow(const std::vector<PlacedLayer>& layers, const PrintSettings& settings,
                 const Printer& printer);

/// The share of the seconds in which `flow` is held.
double share_held(const std::vector<PlacedLayer>& layers, PrintSettings settings, const Printer& printer,
                  double flow);

}  // namespace unicursal::gcode
