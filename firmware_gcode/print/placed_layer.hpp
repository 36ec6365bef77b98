// The input of firmware_gcode: the bead paths of a layer on the bed. mm.
#pragma once

#include <cstddef>
#include <vector>

#include "core/curve/bead_path.hpp"
#include "core/geometry/polygon.hpp"

namespace unicursal::gcode {

/// Bead paths in the frame of the bed.
struct PlacedLayer {
  std::size_t index = 0;
  double top = 0;  ///< height of the nozzle
  double height = 0;
  std::vector<core::BeadPath> paths;
  std::vector<core::Polygon> outlines = {};  ///< of the islands, for hidden seams and detours; may be absent
};

/// Whether the layer lies on the bed, as the first of each part does.
inline bool rests_on_bed(const PlacedLayer& layer) {
  constexpr double rounding = 1e-6;  // mm, of a sum of layer heights
  return layer.top <= layer.height + rounding;
}

/// Where the closed curve of a layer begins and ends. A seam moves at most 1.5 bead widths per layer, so that
/// none of these adds a travel.
enum class Seam {
  hidden,     ///< inside the part; if that is impossible, in a notch of the outline
  scattered,  ///< at a different place in every layer
  aligned,    ///< above each other
  nearest     ///< at the shortest distance from the last end
};

inline constexpr double travel_widths = 1.5;  ///< bead widths; a longer move without extrusion is a travel

/// The number of layers over which the route is optimised.
inline constexpr std::size_t default_horizon = 4;

}  // namespace unicursal::gcode
