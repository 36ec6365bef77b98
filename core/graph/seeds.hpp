// Seeds of the cell graph: a triangular tiling with jitter, relaxed to a centroidal Voronoi tessellation
// (paper §3.2, Figure 3, without needles). mm.
#pragma once

#include <vector>

#include "core/geometry/polygon.hpp"
#include "core/geometry/random.hpp"

namespace unicursal::core {

/// Seeds at a distance of about `d` from one another inside `domain`. Departures from the paper: the tiling
/// is turned and shifted at random, so that layers do not repeat each other; places that the tiling leaves
/// farther than 0.75 d from every seed (narrow tips) get one; the relaxation is Lloyd's on a sampling
/// lattice, where few steps suffice from such a start. At least one seed.
std::vector<Vec2> place_seeds(const Polygon& domain, double d, Random& random);

}  // namespace unicursal::core
