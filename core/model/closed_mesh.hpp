// Makes a mesh that bounds a solid from loose triangles.
//
// Repaired: vertices that nearly coincide are welded, facets that collapse are dropped, walls between two
// solids that share them are removed, facets that face the wrong way are turned. Refused: edges with one
// facet (holes) or an odd number of facets, and surfaces with only one side.
#pragma once

#include <string>
#include <vector>

#include "core/model/half_edge_mesh.hpp"
#include "core/text/wording.hpp"

namespace unicursal::core {

/// mm: if the mesh is not closed otherwise, vertices this near to each other become one. About ten steps of a
/// float at 100 mm.
inline constexpr double vertex_weld = 1e-4;

/// Throws ModelError naming an edge that cannot be closed, and how many such edges there are.
ClosedMesh closed_mesh(const std::vector<Triangle>& triangles, const std::string& file, Warnings& warnings);

}  // namespace unicursal::core
