// A mesh that bounds a solid: every edge joins two facets, facets run counter-clockwise seen from outside,
// the walls of cavities seen from inside the cavity. Lengths in mm.
//
// What is repaired: vertices that nearly coincide are welded, facets that collapse are dropped, walls between
// two solids that share them are taken out, facets that look the wrong way are turned.
// What is refused: edges with one facet (holes) or an odd number of them, one-sided surfaces.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/model/stl_reader.hpp"
#include "core/text/wording.hpp"

namespace unicursal::core {

/// mm: vertices this near become one if the mesh is not closed otherwise; some ten steps of a float at 100
/// mm.
inline constexpr double vertex_weld = 1e-4;

/// Half-edge 3·f + k runs from corner k of facet f to corner (k + 1) mod 3.
using HalfEdge = std::uint32_t;

struct ClosedMesh {
  std::vector<Vec3> vertices;
  std::vector<std::array<std::uint32_t, 3>> facets;
  std::vector<HalfEdge> twins;  ///< for every half-edge the one across; it runs the other way

  std::uint32_t from(HalfEdge h) const { return facets[h / 3][h % 3]; }
  std::uint32_t to(HalfEdge h) const { return facets[h / 3][(h % 3 + 1) % 3]; }
};

/// Throws ModelError naming an edge that cannot be closed, and how many such edges there are.
ClosedMesh closed_mesh(const std::vector<Triangle>& triangles, const std::string& file, Warnings& warnings);

}  // namespace unicursal::core
