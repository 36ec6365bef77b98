// Perfect matching of the cell graph (paper §3.3.1; Petersen: every bridgeless cubic graph has one).
#pragma once

#include <utility>
#include <vector>

namespace unicursal::core {

/// For each edge, whether it is matched. Empty when there is no perfect matching. Parallel edges are
/// allowed, loops are not. LEMON's blossom method; in practice linear on cell graphs (tests/bench/matching).
std::vector<bool> perfect_matching(int node_count, const std::vector<std::pair<int, int>>& edges);

/// The same of greatest total weight, for a cycle that avoids what the weights ask to leave out. Slower:
/// O(n m log n) at worst, about n log n on cell graphs.
std::vector<bool> heaviest_perfect_matching(int node_count, const std::vector<std::pair<int, int>>& edges,
                                            const std::vector<int>& weights);

}  // namespace unicursal::core
