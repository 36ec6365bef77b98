// Finds the two facets that meet at each edge. Where solids touch along an edge, four or more facets meet
// there; two facets that bound the same wedge of material belong together.
#pragma once

#include <cstddef>
#include <optional>
#include <utility>

#include "core/model/half_edge_mesh.hpp"

namespace unicursal::core {

struct EdgePairing {
  std::size_t open = 0;                          ///< edges with one facet
  std::size_t tangled = 0;                       ///< edges whose facets cannot be paired
  std::optional<std::pair<Vec3, Vec3>> example;  ///< the ends of one such edge, of an open one if possible
};

/// Sets `mesh.twins` from `mesh.vertices` and `mesh.facets`. The twins are complete if both counts are zero.
EdgePairing pair_edges(ClosedMesh& mesh);

}  // namespace unicursal::core
