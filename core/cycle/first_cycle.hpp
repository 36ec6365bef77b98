// The first Hamiltonian cycle (paper §3.3.1 and §3.3.2): perfect matching, inversion, one centre node per
// cell, split-and-reconnect, and edge doubling as the last resort.
#pragma once

#include <cstddef>
#include <optional>

#include "core/cycle/tour.hpp"
#include "core/graph/cell_graph.hpp"

namespace unicursal::core {

/// One closed walk through every node of the cell graph and every centre that could be reached.
struct Cycle {
  Tour tour;
  std::size_t nodes = 0;                ///< visited nodes; doubled ones count twice
  std::size_t unreached_centres = 0;    ///< cells without a kernel, or whose sides were all taken by others
  std::size_t split_and_reconnect = 0;  ///< paper Table 1
  std::size_t doubled_edges = 0;        ///< paper Table 1
};

/// Returns nullopt if the graph has no perfect matching, or if a cycle can only be joined over bent edges of
/// the border, which are not doubled. Both are rare, and other seeds help: callers try again with other
/// seeds, and in the end use a contour.
///
/// Departure from the paper, which starts from any perfect matching and leaves directions to a random search:
/// if a cost is given, the heaviest perfect matching is removed, so that the remaining cycles cover all nodes
/// at the least possible cost. Centres and joins are also chosen by their cost.
std::optional<Cycle> first_cycle(const CellGraph& cells, const RunCost& cost = {});

}  // namespace unicursal::core
