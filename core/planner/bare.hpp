// What the curves of an island leave bare of it as it is, spikes and walls included: what is farther than
// 0.75 bead widths from them.
#pragma once

#include "core/geometry/polygon.hpp"
#include "core/planner/island_plan.hpp"

namespace unicursal::core {

struct Bare {
  double area = 0;         ///< mm²
  double axis_length = 0;  ///< of the medial axis where the island is narrow, but not below `least_width`, mm
};

/// `bead_width` and `least_width`, of a bead, in mm.
Bare look_for_bare(const IslandPlan& plan, const Polygon& island, double bead_width, double least_width);

}  // namespace unicursal::core
