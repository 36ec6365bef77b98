// The lines along which the cosine of the phase is zero, as closed curves inside the region. mm.
#pragma once

#include <vector>

#include "core/curve/curve.hpp"
#include "core/geometry/border_index.hpp"
#include "core/geometry/polygon.hpp"
#include "core/stripes/phase.hpp"

namespace unicursal::core {

/// Simple, disjoint loops, all with the negative values of the cosine on their left. Near the border the
/// values are raised, so that lines turn back half a bead width inside it, or nearer in thin places. Loops
/// that are too short for a strand are left out.
std::vector<Curve> zero_lines(const Phase& phase, const Polygon& region, const BorderIndex& border,
                              double bead_width);

}  // namespace unicursal::core
