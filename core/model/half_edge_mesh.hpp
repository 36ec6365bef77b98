// The surface of a solid as facets that know their neighbours. Lengths in mm.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/model/stl_reader.hpp"

namespace unicursal::core {

/// Half-edge 3·f + k runs from corner k of facet f to corner (k + 1) mod 3.
using HalfEdge = std::uint32_t;

/// Every edge joins two facets. Facets run counter-clockwise seen from outside the material, so the wall of a
/// cavity does so seen from inside the cavity. closed_mesh() makes it so; until then `twins` may be
/// incomplete.
struct ClosedMesh {
  std::vector<Vec3> vertices;
  std::vector<std::array<std::uint32_t, 3>> facets;
  std::vector<HalfEdge> twins;  ///< per half-edge the one of the neighbouring facet, which runs the other way

  std::uint32_t from(HalfEdge h) const { return facets[h / 3][h % 3]; }
  std::uint32_t to(HalfEdge h) const { return facets[h / 3][(h % 3 + 1) % 3]; }
};

}  // namespace unicursal::core
