// Directions that follow the border of a region, holes included, extended smoothly to the inside. The paper
// has patterns "parallel" and "orthogonal" to the boundary (§3.1, Figures 11 and 25) but leaves open how to
// extend them.
//
// V (see direction_field.hpp) is fixed in every square that the border meets: there it is the mean of the
// border's tangents, weighted by length, so that a jagged border counts by its general direction. Inside, V
// minimises ∫ ‖∇V‖² / d², where d is the distance to the border. Turning near the border costs more than
// turning in the middle, so strands keep parallel to the border for most of the way and turn between opposite
// borders.
//
// Next to a straight border, a point at distance d averages the border's V with the weight d³/r⁴ over the
// distance r (L. Caffarelli and L. Silvestre 2007, with their exponent −2). Without the factor 1/d²
// (Laplace's equation, weight d/r²) every far corner would have an influence. With the V of the nearest
// border point alone, the field would tear along the medial axis. Finally V is scaled to unit length. Where
// it vanishes (in singular points, and on lines where two borders cancel each other) it stays zero.
//
// Solver: full multigrid with red-black Gauss–Seidel and bilinear prolongation. Time is linear in the number
// of squares; the result depends only on the arguments.
#pragma once

#include <vector>

#include "core/field/grid.hpp"
#include "core/geometry/region.hpp"

namespace unicursal::core {

/// Per square: V of the direction parallel to the border, of length 1 or 0; 0 outside the region. −V is the
/// direction at right angles to the border. Precondition: the grid surrounds the region.
std::vector<Vec2> extended_tangents(const Grid& grid, const Region& region);

}  // namespace unicursal::core
