// The exact Voronoi diagram of a closed curve's open segments and vertices, cut off at the island's border
// (paper Appendix A, (11) to (23), Figure 27). It decides on areas and coverage, which the sampling lattice
// only approximates. mm, mm², mm⁴.
//
// Departure from the paper: parabolic borders between a vertex and a segment are integrated as parabolas, not
// as k = 10 straight pieces. All integrals run along the cells' borders (Green), with enough Gauss points to
// be exact for the polynomials that occur, in a form that vanishes along lines towards the site.
//
// Areas add up to that of the island to 1e-12 in spite of rounding: neighbouring cells share the very arcs
// between them, and each arc is weighted by the border's winding number, which is −1 where clipping on a grid
// has flipped a spike.
//
// The work is done in three parts, each in files of its own: piece_diagram.hpp builds CGAL's diagram near one
// piece of the island, cell_walk.hpp clips the cells' borders by the piece, and cell_integrals.hpp integrates
// along them.
#pragma once

#include <vector>

#include "core/geometry/cell_integrals.hpp"
#include "core/geometry/polygon.hpp"
#include "core/numeric/parallel.hpp"

namespace unicursal::core {

struct SegmentDiagram {
  std::vector<CellIntegrals> points;    ///< cell of vertex i
  std::vector<CellIntegrals> segments;  ///< cell of the open segment from vertex i to its successor
};

/// `curve` is a closed ring: simple, strictly inside `island`, with at least three vertices. A large island
/// is divided along straight lines, and each piece's part of the diagram is computed from the segments near
/// it. So time is linear, memory is bounded, and the result is the same for any number of workers.
SegmentDiagram segment_diagram(const Ring& curve, const Polygon& island, Workers* workers = nullptr);

}  // namespace unicursal::core
