// Seeds of the cell graph: a triangular tiling with jitter, relaxed to a centroidal Voronoi tessellation
// (paper §3.2, Figure 3, without needles). mm.
#pragma once

#include <optional>
#include <vector>

#include "core/geometry/lattice_owners.hpp"
#include "core/geometry/polygon.hpp"
#include "core/numeric/random.hpp"

namespace unicursal::core {

struct SeedOptions {
  double d = 1;  ///< mm between neighbouring seeds
  /// Radians: rows of the tiling run this way. Random when empty, so that layers do not repeat each other.
  std::optional<double> rows;
  double stretch = 1;  ///< of the tiling along its rows; across them it shrinks, so that as many seeds remain
};

/// Seeds at a distance of about `d` from one another inside `domain`. Departures from the paper: the tiling
/// is turned and shifted at random; places that it leaves farther than 0.75 d from every seed
/// (narrow tips) get one; the relaxation is Lloyd's on a sampling lattice, where few steps suffice from such
/// a start. At least one seed.
std::vector<Vec2> place_seeds(const Polygon& domain, const SeedOptions& options, Random& random);
inline std::vector<Vec2> place_seeds(const Polygon& domain, double d, Random& random) {
  return place_seeds(domain, SeedOptions{d, {}, 1}, random);
}

/// Seeds as segments without length.
std::vector<Segment> as_points(const std::vector<Vec2>& seeds);

}  // namespace unicursal::core
