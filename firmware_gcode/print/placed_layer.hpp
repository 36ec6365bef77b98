// What comes into firmware_gcode: a layer's bead paths on the bed. mm.
#pragma once

#include <cstddef>
#include <vector>

#include "core/curve/bead_path.hpp"
#include "core/geometry/polygon.hpp"

namespace unicursal::gcode {

/// One layer ready to print: bead paths in the bed's frame.
struct PlacedLayer {
  std::size_t index = 0;
  double top = 0;  ///< where the nozzle runs
  double height = 0;
  std::vector<core::BeadPath> paths;
  std::vector<core::Polygon> outlines =
      {};  ///< of the islands: for hidden seams and travels round them; may be absent
};

/// Where the cycle of a layer begins and ends, as far as that is free: none of these makes a travel.
enum class Seam {
  hidden,     ///< inside the part, else in a notch of its outline
  scattered,  ///< another place in every layer
  aligned,    ///< one above the other
  nearest     ///< wherever it costs the least way
};

inline constexpr double travel_widths = 1.5;  ///< bead widths; a longer move without extruding is a travel

/// Layers that the route is chosen over together.
inline constexpr std::size_t default_horizon = 4;

}  // namespace unicursal::gcode
