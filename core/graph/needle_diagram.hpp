// The Voronoi diagram of needles, that is, of short segments that do not meet (paper §3.2, Figure 4). mm.
//
// Departure from the paper: the parabolic arcs do not matter here, only which cells meet where. So every
// needle is replaced by a row of points, and the edges of the point diagram between points of one needle are
// left out. With five points on a needle of half a seed distance the nodes are within 0.01 seed distances of
// the exact ones. Edges are drawn straight from node to node wherever the drawing stays plane.
#pragma once

#include <optional>
#include <vector>

#include "core/geometry/lattice_owners.hpp"
#include "core/graph/voronoi.hpp"

namespace unicursal::core {

/// Cell i belongs to needle i; a needle may be a point. Returns nullopt if a cell surrounds another, which
/// hardly happens if every needle stays within the Voronoi cell of its middle.
std::optional<Voronoi> needle_diagram(const std::vector<Segment>& needles, const Box& box);

/// Joins the cells of each group to one cell: edges within a group are removed, and a vertex that keeps two
/// edges becomes a bend. `group` maps every site's cell to its cell in the result; these are numbered from 0
/// without gaps. Returns nullopt if a ring without vertices is left.
std::optional<Voronoi> merged(const Voronoi& diagram, const Per<CellIndex, CellIndex>& group);

/// Removes the bends of all edges, except where straight lines would meet or turn a cell inside out. Cells
/// from number `cells` on (those of far sites) are not checked.
void straighten(Voronoi& diagram, std::size_t cells);

}  // namespace unicursal::core
