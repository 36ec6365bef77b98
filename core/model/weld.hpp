// Makes a mesh of shared vertices from loose triangles.
#pragma once

#include <cstddef>
#include <vector>

#include "core/model/half_edge_mesh.hpp"

namespace unicursal::core {

/// Vertices with equal coordinates become one. Facets keep their order; twins are not set.
ClosedMesh indexed(const std::vector<Triangle>& triangles);

/// mm: how far apart two vertices may lie that were meant to be one. Files hold single precision, so this
/// grows with the distance from the origin; 1e-4 mm within 100 mm.
double weld_distance(const ClosedMesh& mesh);

/// Vertices within `distance` of an earlier one become that one. Returns how many moved. A closed surface
/// stays closed.
std::size_t weld(ClosedMesh& mesh, double distance);

/// Drops facets with two equal corners, and returns their number. Their other two sides are one edge, so no
/// hole opens.
std::size_t drop_collapsed(ClosedMesh& mesh);

/// Drops copies of facets that stand in the way of a closed surface, and returns their number. `borders`: the
/// half-edges without a twin.
std::size_t drop_copies(ClosedMesh& mesh, const std::vector<MeshEdge>& borders);

}  // namespace unicursal::core
