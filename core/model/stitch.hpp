// Stitches T-junctions: where vertices of one border lie within an edge of another, the edge's facet is split
// there.
#pragma once

#include <cstddef>
#include <vector>

#include "core/model/half_edge_mesh.hpp"

namespace unicursal::core {

/// Splits facets at vertices of `borders` (half-edges without a twin) that lie within `reach` (mm) of their
/// sides. Returns how many vertices were found; twins are lost if there is one.
std::size_t stitch(ClosedMesh& mesh, std::vector<MeshEdge> borders, double reach);

}  // namespace unicursal::core
