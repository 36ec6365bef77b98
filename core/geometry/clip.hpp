// Clips rings at lines parallel to the axes (Sutherland and Hodgman). mm. For a non-convex ring the result
// may contain edges that run back and forth along the line; they cancel in every moment and in even-odd
// counts.
#pragma once

#include <vector>

#include "core/geometry/polygon.hpp"

namespace unicursal::core {

/// The side that is kept: points left or right of x, below or above y; points on the line are kept too.
enum class Side { left, right, below, above };

Ring clipped(const Ring& ring, Side side, double at);
/// Clips each ring; rings that vanish are left out.
std::vector<Ring> clipped(const std::vector<Ring>& rings, Side side, double at);

}  // namespace unicursal::core
