// Travels that go round what is printed: over no other island and over no hole, where a short way does
// without. Obstacles count as their convex hulls, a little larger. mm.
#pragma once

#include <vector>

#include "core/geometry/polygon.hpp"

namespace unicursal::gcode {

/// Places to go through on the way from one point to another; none if the straight way is free, or if going
/// round is longer by half and 10 mm. An obstacle that either point lies in is none. `within`: the bed.
std::vector<core::Vec2> detour(const core::Vec2& from, const core::Vec2& to,
                               const std::vector<core::Polygon>& outlines, const core::Box& within);

}  // namespace unicursal::gcode
