// The Voronoi diagram of points, or of needles (needle_diagram.hpp), with the connectivity that a planar
// graph needs. mm.
#pragma once

#include <array>
#include <vector>

#include "core/geometry/polygon.hpp"
#include "core/graph/index.hpp"

namespace unicursal::core {

using VoronoiVertexIndex = Index<struct VoronoiVertexTag>;
using VoronoiEdgeIndex = Index<struct VoronoiEdgeTag>;
using CellIndex = Index<struct CellTag>;  ///< cell i belongs to site i; the cells of far sites follow

struct VoronoiEdge {
  VoronoiVertexIndex from, to;
  CellIndex left, right;  ///< the cells on its two sides
  Ring via;               ///< bends on the way; always empty in a diagram of points
};

/// A vertex where three cells meet.
struct VoronoiVertex {
  Vec2 position{0, 0};
  std::array<VoronoiEdgeIndex, 3> edges;  ///< counter-clockwise; an edge that runs to infinity is invalid
};

struct Voronoi {
  Per<VoronoiVertexIndex, VoronoiVertex> vertices;
  Per<VoronoiEdgeIndex, VoronoiEdge> edges;
};

/// Cells within `box` are complete: far sites are added so that no edge near the box runs to infinity.
Voronoi voronoi(const std::vector<Vec2>& sites, const Box& box);

}  // namespace unicursal::core
