// Perfect matching of the cell graph (paper §3.3.1; Petersen: every bridgeless cubic graph has one).
#pragma once

#include <cstddef>
#include <utility>

#include "core/graph/index.hpp"

namespace unicursal::core {

/// The two nodes that an edge joins.
using EdgeEnds = std::pair<NodeIndex, NodeIndex>;

/// For each edge, whether it is matched. Empty if there is no perfect matching. Parallel edges are allowed,
/// loops are not. LEMON's blossom method; in practice linear on cell graphs (tests/bench/matching).
Per<EdgeIndex, bool> perfect_matching(std::size_t node_count, const Per<EdgeIndex, EdgeEnds>& edges);

/// The perfect matching of greatest total weight, for a cycle that avoids the edges of great weight. Slower:
/// O(n m log n) at worst, about n log n on cell graphs.
Per<EdgeIndex, bool> heaviest_perfect_matching(std::size_t node_count, const Per<EdgeIndex, EdgeEnds>& edges,
                                               const Per<EdgeIndex, int>& weights);

}  // namespace unicursal::core
