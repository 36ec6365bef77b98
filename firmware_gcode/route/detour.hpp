// Travels that go around printed islands and holes if the way around is short. Obstacles count as their
// convex hulls plus a clearance. mm.
#pragma once

#include <vector>

#include "core/geometry/polygon.hpp"

namespace unicursal::gcode {

/// Returns the via points of a travel between two points. Empty if the straight way is free, or if every way
/// around is longer than 1.5 times the straight way plus 10 mm. Obstacles that contain either point are
/// ignored. `within` is the bed.
std::vector<core::Vec2> detour(const core::Vec2& from, const core::Vec2& to,
                               const std::vector<core::Polygon>& outlines, const core::Box& within);

}  // namespace unicursal::gcode
