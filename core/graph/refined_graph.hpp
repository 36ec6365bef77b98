// The refined graph (paper §3.3.2): a centre node in every cell, joined to all nodes of the cell, so that
// cells fall into triangles and there is more to choose from.
#pragma once

#include <vector>

#include "core/graph/cell_graph.hpp"
#include "core/graph/planar_graph.hpp"

namespace unicursal::core {

/// Nodes and edges of the cell graph keep their numbers; centres and their edges follow.
struct RefinedGraph : PlanarGraph {
  std::size_t cell_nodes = 0;     ///< nodes below this number are the cell graph's
  std::size_t cell_edges = 0;     ///< edges below this number are the cell graph's
  std::vector<NodeIndex> centre;  ///< per cell of the cell graph, −1 for a cell without

  bool is_centre(NodeIndex n) const { return static_cast<std::size_t>(n) >= cell_nodes; }
};

/// A cell gets its centre where the whole outline is in straight sight of it: at its centroid, else in the
/// middle of its kernel. Departure from the paper: a cell without kernel (its border is badly bent) has no
/// centre, so that the graph stays plane.
RefinedGraph refine(const CellGraph& cells);

}  // namespace unicursal::core
