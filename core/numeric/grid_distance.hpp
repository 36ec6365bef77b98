// How far the squares of a grid are from marked squares: the exact Euclidean distance transform in linear
// time (P. Felzenszwalb and D. Huttenlocher 2012: lower envelopes of parabolas, first along the lines of the
// grid, then across them).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace unicursal::core {

/// The distance from the centre of each square to that of the nearest marked square, in squares; infinite if
/// none is marked. The grid has `lines` lines of `length` squares each (its columns or its rows), one after
/// the other.
std::vector<double> distance_to_marked(std::size_t lines, std::size_t length,
                                       const std::vector<std::uint8_t>& marked);

}  // namespace unicursal::core
