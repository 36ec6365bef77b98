// The space below a painted surface: what is printed in the colour of the paint.
//
// The painted facets, the same facets moved inwards, and walls along the border of the paint bound a shell.
// Each vertex of the mesh moves along the mean normal of the facets around it, so that shells of two colours
// meet at half of the angle of an edge, and neither shows on the other's side. A shell ends half-way to the
// opposite side of a thin wall.
#pragma once

#include <vector>

#include "core/model/half_edge_mesh.hpp"
#include "core/model/mesh_model.hpp"

namespace unicursal::core {

/// One shell for each of the body's paints, which may be empty. `mesh`: the body after mending; `depth`: mm.
/// Where mending has split a triangle, each facet of it takes the paint that has most of the triangle. The
/// section of a shell is what its contours enclose by the non-zero rule, within the section of the body.
std::vector<ClosedMesh> painted_shells(const MeshBody& body, const ClosedMesh& mesh, double depth);

}  // namespace unicursal::core
