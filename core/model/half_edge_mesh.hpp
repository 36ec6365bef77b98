// The surface of a solid as facets that know their neighbours. Lengths in mm.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/model/triangle.hpp"

namespace unicursal::core {

/// Half-edge 3·f + k runs from corner k of facet f to corner (k + 1) mod 3.
using MeshEdge = std::uint32_t;
inline constexpr MeshEdge no_half_edge = std::numeric_limits<MeshEdge>::max();
/// The source of a facet that closes a hole.
inline constexpr std::uint32_t no_source = std::numeric_limits<std::uint32_t>::max();

/// A closed surface: along every edge as many facets run one way as the other, so that every point of space
/// has a winding number. Facets run counter-clockwise seen from outside the material, so the wall of a cavity
/// does so seen from inside the cavity. closed_mesh() makes it so; until then half-edges may have no twin.
struct ClosedMesh {
  std::vector<Vec3> vertices;
  std::vector<std::array<std::uint32_t, 3>> facets;
  std::vector<MeshEdge> twins;  ///< per half-edge: one of a neighbouring facet, which runs the other way
  std::vector<std::uint32_t> sources;  ///< per facet: the triangle of the file that it is, or is a piece of

  std::uint32_t from(MeshEdge h) const { return facets[h / 3][h % 3]; }
  std::uint32_t to(MeshEdge h) const { return facets[h / 3][(h % 3 + 1) % 3]; }
};

}  // namespace unicursal::core
