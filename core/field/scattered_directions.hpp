// Directions that are known at scattered points, interpolated on a grid. Each square has the mean of the
// samples around its centre, in doubled angle, weighted by inverse squared distance (D. Shepard 1968, in the
// local form of R. Franke and G. Nielson 1980). Squares farther than two sample spacings from any sample ask
// for no direction.
//
// Samples with different z form a field in space: samples near the height of the cut count, by their distance
// in space. If all samples have the same z, they apply at every height.
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

  /// Spacing of the samples, mm: the side of the square (or cube) that each sample has for itself, on average
  /// over the region that they occupy.
  double spacing() const { return spacing_; }

  /// Per square: V of length 1 or 0, at height `z` mm; 0 also where `share` is 0. Time is linear in samples
  /// and squares, however the samples lie: samples in the same small square count as one.
  std::vector<Vec2> on_grid(const Grid& grid, const std::vector<double>& share, double z) const;

 private:
  std::vector<DirectionSample> samples_;
  bool in_space_;  ///< the samples have different z
  double spacing_;
};

}  // namespace unicursal::core
