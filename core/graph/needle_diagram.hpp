// The Voronoi diagram of needles, that is, of short segments that do not meet (paper §3.2, Figure 4). mm.
//
// Departure from the paper: only which cells meet where matters here, not the parabolic arcs. So every needle
// is taken as a row of points, and what the point diagram draws between points of one needle is left
// out. With five points to a needle of half a seed distance the nodes are within 0.01 seed distances of the
// exact ones. Edges are drawn straight from node to node wherever the drawing stays plane.
#pragma once

#include <optional>
#include <vector>

#include "core/geometry/lattice_owners.hpp"
#include "core/graph/voronoi.hpp"

namespace unicursal::core {

/// Cell i is that of needle i; needles of no length are points. Nothing when a cell surrounds another, which
/// needles that keep to the Voronoi cells of their middles hardly do.
std::optional<Voronoi> needle_diagram(const std::vector<Segment>& needles, const Box& box);

/// Joins cells of one group: edges within a group go, and what remains of a vertex with two edges is a bend.
/// `group` holds a number for every site, from 0 without gaps. Nothing when a ring without vertices is left.
std::optional<Voronoi> merged(const Voronoi& diagram, const std::vector<int>& group);

/// Takes out the bends of all edges but those where straight lines would meet or turn a cell inside out.
/// Cells from `cells` on (the far ones) are not looked at.
void straighten(Voronoi& diagram, std::size_t cells);

}  // namespace unicursal::core
