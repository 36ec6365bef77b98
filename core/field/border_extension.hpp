// Directions that follow a region's border, extended smoothly inside, holes included (paper §3.1 and Figures
// 11, 25: "parallel" and "orthogonal" to the boundary; how to extend is left open there).
//
// V (see direction_field.hpp) of the border's tangents is held fixed in every square that the border meets,
// as the mean weighted by length, so that a jagged border counts by its general run. Inside, V solves
// Laplace's equation: the smoothest extension in the sense of least ∫ ‖∇V‖². It is then scaled to unit
// length. Where V vanishes (singular points, and lines where two borders cancel each other) it stays zero.
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
