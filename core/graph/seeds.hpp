// Seeds of the cell graph: a jittered triangular tiling, relaxed to a centroidal Voronoi tessellation (paper
// §3.2, Figure 3, without needles). mm.
#pragma once

#include <optional>
#include <vector>

#include "core/geometry/lattice_owners.hpp"
#include "core/geometry/polygon.hpp"
#include "core/numeric/random.hpp"

namespace unicursal::core {

struct SeedOptions {
  double d = 1;  ///< distance between neighbouring seeds, mm
  /// Direction of the tiling's rows, rad. Random if absent, so that layers do not repeat each other.
  std::optional<double> rows;
  double stretch =
      1;  ///< factor on the tiling along its rows; it shrinks across them, to keep the number of seeds
};

/// Seeds inside `domain`, about `d` apart; at least one. Departures from the paper: the tiling is turned and
/// shifted at random; places that are farther than 0.75 d from every seed (narrow tips) get an additional
/// one; the relaxation is Lloyd's method on a sampling lattice, for which few steps suffice from such a
/// start.
std::vector<Vec2> place_seeds(const Polygon& domain, const SeedOptions& options, Random& random);
inline std::vector<Vec2> place_seeds(const Polygon& domain, double d, Random& random) {
  return place_seeds(domain, SeedOptions{d, {}, 1}, random);
}

/// Seeds as segments of no length.
std::vector<Segment> as_points(const std::vector<Vec2>& seeds);

}  // namespace unicursal::core
