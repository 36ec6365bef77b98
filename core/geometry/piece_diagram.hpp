// First part of the segment diagram: the Voronoi diagram of a curve's segments near one piece of the island,
// built by CGAL, with vertices as exact as double precision allows. mm.
#pragma once

#include <cstddef>
#include <vector>

#include "core/geometry/curve_sites.hpp"

namespace unicursal::core {

/// A stretch of the border between two cells, straight or parabolic; the left site's cell lies to its left.
struct CellBorder {
  CurveSite left, right;  ///< `left` is the lesser site
  Vec2 from{0, 0}, to{0, 0};
};

/// The vertices of the given segments, ascending.
std::vector<std::size_t> vertices_of(const CurveSites& sites, const std::vector<std::size_t>& segments);

/// All borders between cells of the diagram of the given segments (ascending) and their vertices, in an order
/// that depends only on the arguments.
std::vector<CellBorder> piece_diagram(const CurveSites& sites, const std::vector<std::size_t>& segments);

}  // namespace unicursal::core
