// Which facets meet at an edge. Normally two; where solids touch along an edge four or more do, and the two
// that bound the same wedge of material belong together.
#pragma once

#include <cstddef>
#include <optional>
#include <utility>

#include "core/model/half_edge_mesh.hpp"

namespace unicursal::core {

struct EdgePairing {
  std::size_t open = 0;                          ///< edges with one facet
  std::size_t tangled = 0;                       ///< edges whose facets cannot be paired
  std::optional<std::pair<Vec3, Vec3>> example;  ///< the ends of one of them, an open one if there is any
};

/// Sets `mesh.twins` from `mesh.vertices` and `mesh.facets`; complete if neither count is above zero.
EdgePairing pair_edges(ClosedMesh& mesh);

}  // namespace unicursal::core
