// The exact Voronoi diagram of a closed curve's open segments and vertices, cut off at the island's border
// (paper Appendix A, (11) to (23), Figure 27): the judge of areas and coverage. mm, mm², mm⁴.
//
// Departure from the paper: parabolic borders between a vertex and a segment are integrated as what they are,
// not as k = 10 straight pieces. All integrals run along the cells' borders (Green) with Gauss points enough
// to be exact for the polynomials that occur, in a form that vanishes along lines towards the site.
//
// Areas add up to that of the island to 1e-12 whatever the rounding: neighbouring cells share the very arcs
// between them, and arcs count as often as the island's border winds around them, which clipping on a grid
// makes −1 in places where it turns the sides of a spike around.
#pragma once

#include <vector>

#include "core/geometry/polygon.hpp"
#include "core/numeric/parallel.hpp"

namespace unicursal::core {

struct CellIntegrals {
  double area = 0;           ///< ∫ 1, mm²
  double second_moment = 0;  ///< ∫ dist², mm⁴; the cell's part of E_CVT (13)
};

struct SegmentDiagram {
  std::vector<CellIntegrals> points;    ///< cell of vertex i
  std::vector<CellIntegrals> segments;  ///< cell of the open segment from vertex i to its successor
};

/// `curve` is a closed ring: simple, strictly inside `island`, with at least three vertices. Large islands
/// are divided along lines, and each piece's part of the diagram comes from the segments within reach of it:
/// time is linear, memory bounded, and the result the same for any number of workers.
SegmentDiagram segment_diagram(const Ring& curve, const Polygon& island, Workers* workers = nullptr);

}  // namespace unicursal::core
