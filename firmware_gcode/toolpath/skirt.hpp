// Rings around the first layer that start the flow of the melt before the part begins. They follow the convex
// hull of the layer, so that they keep clear of it, and lie on the bed. mm.
#pragma once

#include <optional>
#include <vector>

#include "core/curve/bead_path.hpp"
#include "firmware_gcode/print/print_settings.hpp"
#include "firmware_gcode/print/printer.hpp"

namespace unicursal::gcode {

/// Returns the rings, the outermost first, with beads of zone 0 and the layer's mean width. If the bed has no
/// room for the requested distance, the rings move nearer to the part, up to one bead width. Returns no rings
/// if even that does not fit, or if none are requested.
std::vector<core::BeadPath> skirt(const PlacedLayer& layer, const Skirt& asked, const Printer& printer);

/// The greatest distance of a ring's outer edge from the part's extent; 0 without rings.
double skirt_reach(const Skirt& asked, const Printer& printer);

}  // namespace unicursal::gcode
