// Directions known at scattered points, spread over a grid: each square takes the mean of the samples
// around its centre, weighted by inverse squared distance (D. Shepard 1968, in the local form of R. Franke
// and G. Nielson 1980), in doubled angle. Farther than two sample spacings from any sample nothing is asked.
//
// Samples whose z differs are a field in space: those near the height of the cut count, and distances are
// spatial. Samples that all have one z hold at every height.
//
//   const ScatteredDirections stress(read_directions("stress.csv"));
//   std::vector<Vec2> v = stress.on_grid(grid, cover(grid, region), layer.z);
#pragma once

#include <vector>

#include "core/field/direction_file.hpp"
#include "core/field/grid.hpp"

namespace unicursal::core {

class ScatteredDirections {
 public:
  /// Precondition: not empty.
  explicit ScatteredDirections(std::vector<DirectionSample> samples);

  /// mm: the side of the square (or cube) that each sample has for itself, on average over the region that
  /// the samples occupy.
  double spacing() const { return spacing_; }

  /// Per square V of length 1 or 0, at height `z` mm; 0 too where `share` is 0. Time grows with samples and
  /// squares, however the samples lie: those that share a small square count as one.
  std::vector<Vec2> on_grid(const Grid& grid, const std::vector<double>& share, double z) const;

 private:
  std::vector<DirectionSample> samples_;
  bool in_space_;  ///< z matters
  double spacing_;
};

}  // namespace unicursal::core
