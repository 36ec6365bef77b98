// Removes redundant vertices from bead paths: those on a straight piece of equal width. This saves lines on
// the serial connection and changes nothing else: volumes are exact and zones keep their borders.
#pragma once

#include "core/curve/bead_path.hpp"
#include "firmware_gcode/print/print_settings.hpp"

namespace unicursal::gcode {

/// Joins segments of one zone while the vertices in between advance along the straight line within
/// `straight_tolerance` of it and all widths are within `width_tolerance` of each other. Vertex 0 stays.
core::BeadPath simplified(const core::BeadPath& path);
/// Simplifies all paths of a layer.
PlacedLayer simplified(PlacedLayer layer);

inline constexpr double straight_tolerance = 0.01;  ///< mm, less than a motor's step
inline constexpr double width_tolerance = 0.01;     ///< relative

}  // namespace unicursal::gcode
