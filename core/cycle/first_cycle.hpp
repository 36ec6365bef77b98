// The first Hamiltonian cycle (paper §3.3.1 and §3.3.2): perfect matching, inversion, one centre node per
// cell, split-and-reconnect, edge doubling as the last resort.
#pragma once

#include <cstddef>
#include <optional>

#include "core/cycle/tour.hpp"
#include "core/graph/cell_graph.hpp"

namespace unicursal::core {

/// One closed walk through every node of the cell graph and every centre that could be reached.
struct Cycle {
  Tour tour;
  std::size_t nodes = 0;                ///< visited, doubled ones twice
  std::size_t unreached_centres = 0;    ///< cells whose sides were all spoken for, or that have no kernel
  std::size_t split_and_reconnect = 0;  ///< paper Table 1
  std::size_t doubled_edges = 0;        ///< paper Table 1
};

/// Departure from the paper, which starts from any perfect matching and leaves directions to a random search:
/// with a cost the heaviest perfect matching is left out of the cycle, so that the cycles which remain cover
/// all nodes at the least cost there is; centres and joins take the cheapest way too.
///
/// Nothing when the graph has no perfect matching or a cycle hangs on bent edges of the border only, which
/// are not doubled; both are rare, and other seeds help (callers try again, and take a contour in the end).
std::optional<Cycle> first_cycle(const CellGraph& cells, const RunCost& cost = {});

}  // namespace unicursal::core
