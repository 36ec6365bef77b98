// In what order the paths of a layer come: an open tour from where the last layer ended, with as few travels
// as may be and those short. Nearest neighbour, then 2-opt and single moves. mm.
#pragma once

#include <cstddef>
#include <vector>

#include "firmware_gcode/print/placed_layer.hpp"

namespace unicursal::gcode {

/// What it costs to go from one path to another: the way between their nearest vertices, and `travel_cost`
/// more if that is a travel.
double way_between(const core::BeadPath& from, const core::BeadPath& to);

inline constexpr double travel_cost = 1000;  ///< mm of way that a travel more is worth avoiding by

/// Indices into `paths`. `before`: the path that the last layer ended with, may be null; `after`: the next
/// layer's paths, so that the last one here is one that they can go on from; may be empty.
std::vector<std::size_t> island_order(const std::vector<const core::BeadPath*>& paths,
                                      const core::BeadPath* before,
                                      const std::vector<const core::BeadPath*>& after);

}  // namespace unicursal::gcode
