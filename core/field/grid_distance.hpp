// The distances of a grid's squares from marked ones: the exact Euclidean distance transform in linear time
// (P. Felzenszwalb and D. Huttenlocher 2012: lower envelopes of parabolas, first along columns, then along
// rows).
#pragma once

#include <cstdint>
#include <vector>

#include "core/field/grid.hpp"

namespace unicursal::core {

/// Per square: the distance from its centre to the centre of the nearest marked square, in squares. Infinite
/// if no square is marked.
std::vector<double> distance_to_marked(const Grid& grid, const std::vector<std::uint8_t>& marked);

}  // namespace unicursal::core
