// The order of a layer's paths: an open tour from the end of the last layer with as few and as short travels
// as possible. Nearest neighbour, then 2-opt and moves of single paths. mm.
#pragma once

#include <cstddef>
#include <vector>

#include "firmware_gcode/print/placed_layer.hpp"

namespace unicursal::gcode {

/// The cost of going from one path to another: the distance of their nearest vertices, plus `travel_cost` if
/// that is a travel.
double way_between(const core::BeadPath& from, const core::BeadPath& to);

inline constexpr double travel_cost = 1000;  ///< mm of additional way that saving a travel is worth

/// Returns indices into `paths`. `before`: the last path of the layer below, may be null. `after`: the paths
/// of the next layer, near which the tour should end; may be empty.
std::vector<std::size_t> island_order(const std::vector<const core::BeadPath*>& paths,
                                      const core::BeadPath* before,
                                      const std::vector<const core::BeadPath*>& after);

}  // namespace unicursal::gcode
