// Takes vertices out of bead paths that say nothing: those on a straight piece of equal width. Fewer lines
// for the serial line, and nothing else changes: volumes are exact, zones keep their borders.
#pragma once

#include "core/curve/bead_path.hpp"
#include "firmware_gcode/print/print_settings.hpp"

namespace unicursal::gcode {

/// Segments are joined while all vertices in between lie within `straight_tolerance` of the straight line,
/// one after the other, in one zone, and all widths within `width_tolerance` of each other. Vertex 0 stays.
core::BeadPath simplified(const core::BeadPath& path);
/// All paths of a layer.
PlacedLayer simplified(PlacedLayer layer);

inline constexpr double straight_tolerance = 0.01;  ///< mm, less than a motor's step
inline constexpr double width_tolerance = 0.01;     ///< relative

}  // namespace unicursal::gcode
