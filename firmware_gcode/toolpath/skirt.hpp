// Rings round the first layer that make the melt run before the part begins. They follow the hull of all that
// the layer holds, so they keep clear of it, and lie on the bed. mm.
#pragma once

#include <optional>
#include <vector>

#include "core/curve/bead_path.hpp"
#include "firmware_gcode/print/print_settings.hpp"
#include "firmware_gcode/print/printer.hpp"

namespace unicursal::gcode {

/// The rings, the outermost first; beads of zone 0, as wide as the layer's are on average. Where the bed has
/// no room for the distance that is asked for they come nearer to the part, but no nearer than a bead width;
/// none where even that does not fit, or if none is asked for.
std::vector<core::BeadPath> skirt(const PlacedLayer& layer, const Skirt& asked, const Printer& printer);

/// How far the rings can reach from the part's extent, for what has to keep clear of them. 0 without any.
double skirt_reach(const Skirt& asked, const Printer& printer);

}  // namespace unicursal::gcode
