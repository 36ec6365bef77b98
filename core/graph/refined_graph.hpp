// The refined graph (paper §3.3.2): a centre node in every cell, joined to all nodes of the cell. Cells fall
// into triangles, so that there are more cycles to choose from.
#pragma once

#include <cstddef>

#include "core/graph/cell_graph.hpp"
#include "core/graph/planar_graph.hpp"

namespace unicursal::core {

/// Nodes and edges of the cell graph keep their numbers; centres and their edges follow.
struct RefinedGraph : PlanarGraph {
  std::size_t cell_nodes = 0;        ///< nodes below this number belong to the cell graph
  std::size_t cell_edges = 0;        ///< edges below this number belong to the cell graph
  Per<FaceIndex, NodeIndex> centre;  ///< for each cell of the cell graph; invalid for a cell without a centre

  bool is_centre(NodeIndex n) const { return n.number() >= cell_nodes; }
};

/// The centre of a cell is a point from which the whole outline is visible: the centroid if possible, else
/// the middle of the cell's kernel. Departure from the paper: a cell without a kernel (its border is badly
/// bent) gets no centre, so that the graph stays plane.
RefinedGraph refine(const CellGraph& cells);

}  // namespace unicursal::core
