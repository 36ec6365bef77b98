// The Voronoi diagram of points, or of needles (needle_diagram.hpp), with the connectivity that a planar
// graph needs. mm.
#pragma once

#include <array>
#include <vector>

#include "core/geometry/polygon.hpp"

namespace unicursal::core {

struct VoronoiEdge {
  int from = 0, to = 0;     ///< Voronoi vertices
  int left = 0, right = 0;  ///< the cells on its two sides; numbers beyond the sites' are of far sites
  Ring via;                 ///< bends on the way; none in a diagram of points
};

/// A vertex where three cells meet; its edges in counter-clockwise order, −1 for one that runs to infinity.
struct VoronoiVertex {
  Vec2 position{0, 0};
  std::array<int, 3> edges{-1, -1, -1};
};

struct Voronoi {
  std::vector<VoronoiVertex> vertices;
  std::vector<VoronoiEdge> edges;
};

/// Cells within `box` are complete: far sites are added so that nothing near it runs to infinity.
Voronoi voronoi(const std::vector<Vec2>& sites, const Box& box);

}  // namespace unicursal::core
