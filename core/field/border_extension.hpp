// Directions that follow a region's border, extended smoothly inside, holes included (paper §3.1 and Figures
// 11, 25: "parallel" and "orthogonal" to the boundary; how to extend is left open there).
//
// V (see direction_field.hpp) of the border's tangents is held fixed in every square that the border meets,
// as the mean weighted by length, so that a jagged border counts by its general run. Inside, V is the field
// of least ∫ ‖∇V‖² / d², d the distance to the border: to turn near the border costs more than in the middle,
// so strands keep parallel to the border for most of the way and the turning happens between opposite
// borders. Next to a straight border each point sees the border's V averaged with d³/r⁴ over the distance r
// (L. Caffarelli and L. Silvestre 2007, with their exponent −2); without the weight (Laplace's equation,
// d/r²) every far corner would be felt, and with V of the nearest border point alone the field would tear
// along the medial axis. V is then scaled to unit length; where it vanishes (singular points, and lines where
// two borders cancel each other) it stays zero.
//
// Solver: full multigrid on the grid, red-black Gauss–Seidel, bilinear prolongation; time is linear in the
// number of squares, and the result depends on nothing but the arguments.
#pragma once

#include <vector>

#include "core/field/grid.hpp"
#include "core/geometry/region.hpp"

namespace unicursal::core {

/// Per square V of the direction parallel to the border, of length 1 or 0; 0 outside the region. The
/// negative is the direction at right angles to the border. Precondition: the grid surrounds the region.
std::vector<Vec2> extended_tangents(const Grid& grid, const Region& region);

}  // namespace unicursal::core
