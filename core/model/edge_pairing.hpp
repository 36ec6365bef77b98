// Finds for each half-edge one that runs the other way. Where more than two facets meet at an edge, those
// that bound the same wedge of material belong together if possible; any other choice bounds the same volume.
#pragma once

#include <cstddef>
#include <vector>

#include "core/model/half_edge_mesh.hpp"

namespace unicursal::core {

/// The half-edges of the mesh, sorted so that those of one edge are neighbours.
struct EdgeUse {
  std::uint32_t low, high;  ///< the edge's vertices
  MeshEdge half_edge;
};
std::vector<EdgeUse> uses_by_edge(const ClosedMesh& mesh);

/// Sets `mesh.twins` and returns the half-edges that have none, in order. The surface is closed if there are
/// none.
std::vector<MeshEdge> pair_edges(ClosedMesh& mesh);

}  // namespace unicursal::core
