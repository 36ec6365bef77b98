// Finds the facets of a mesh that a ray along x may meet, in a grid over y and z. Lengths in mm.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/model/half_edge_mesh.hpp"

namespace unicursal::core {

class RayIndex {
 public:
  /// Takes time and memory in proportion to the number of facets.
  explicit RayIndex(const ClosedMesh& mesh);

  /// All facets that may have a point with these coordinates, and others nearby.
  std::span<const std::uint32_t> near(double y, double z) const;

 private:
  std::size_t row(double value, int axis) const;

  Eigen::Vector2d low_{0, 0}, cell_{1, 1};
  std::size_t rows_ = 1;             ///< of cells, along y and along z
  std::vector<std::size_t> begins_;  ///< per cell where its facets begin in facets_; one more at the end
  std::vector<std::uint32_t> facets_;
};

}  // namespace unicursal::core
