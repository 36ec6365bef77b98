// Closes holes of a surface with facets. The border of a surface consists of closed loops, so it can always
// be done; how much the result is worth depends on how flat the loops are.
#pragma once

#include <cstddef>
#include <vector>

#include "core/model/half_edge_mesh.hpp"

namespace unicursal::core {

struct Hole {
  std::size_t edges = 0;
  double area = 0;      ///< of the facets that close it, mm²
  double doubt = 0;     ///< volume that another way of closing it could add or take away, mm³
  Vec3 place{0, 0, 0};  ///< its middle, mm
};

/// Adds facets along `borders` (all half-edges without a twin), so that every half-edge can find one. Small
/// loops are triangulated with the least area (CGAL, Polygon Mesh Processing), large ones as a fan around
/// their middle; for a flat loop both bound the same volume. Precondition: along the borders every vertex is
/// left as often as it is reached, which is so in every surface.
std::vector<Hole> fill_holes(ClosedMesh& mesh, const std::vector<MeshEdge>& borders);

}  // namespace unicursal::core
