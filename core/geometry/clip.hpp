// Rings cut off at lines along the axes (Sutherland and Hodgman). mm. For a non-convex ring the result may
// hold edges that run back and forth along the line; they cancel in every moment and in even-odd counts.
#pragma once

#include <vector>

#include "core/geometry/polygon.hpp"

namespace unicursal::core {

/// What is kept: the points left or right of x, below or above y; the line itself included.
enum class Side { left, right, below, above };

Ring clipped(const Ring& ring, Side side, double at);
/// Rings that vanish are left out.
std::vector<Ring> clipped(const std::vector<Ring>& rings, Side side, double at);

}  // namespace unicursal::core
