// Compiled as C++17: LEMON 1.3 uses allocator members that C++20 removed.
#include "core/graph/matching.hpp"

#include <lemon/matching.h>
#include <lemon/smart_graph.h>

namespace unicursal::core {

namespace {

using Graph = lemon::SmartGraph;

/// The library's graph; edges in the order given.
struct Network {
  Graph graph;
  std::vector<Graph::Edge> edges;

  Network(int node_count, const std::vector<std::pair<int, int>>& pairs) {
    graph.reserveNode(node_count);
    graph.reserveEdge(static_cast<int>(pairs.size()));
    std::vector<Graph::Node> nodes;
    nodes.reserve(static_cast<std::size_t>(node_count));
    for (int n = 0; n < node_count; ++n) nodes.push_back(graph.addNode());
    edges.reserve(pairs.size());
    for (const auto& pair : pairs) {
      edges.push_back(graph.addEdge(nodes[static_cast<std::size_t>(pair.first)],
                                    nodes[static_cast<std::size_t>(pair.second)]));
    }
  }

  template <typename Matching>
  std::vector<bool> matched(const Matching& matching) const {
    std::vector<bool> result(edges.size());
    for (std::size_t e = 0; e < edges.size(); ++e) result[e] = matching.matching(edges[e]);
    return result;
  }
};

}  // namespace

std::vector<bool> perfect_matching(int node_count, const std::vector<std::pair<int, int>>& edges) {
  const Network network(node_count, edges);
  lemon::MaxMatching<Graph> matching(network.graph);
  matching.run();
  if (2 * matching.matchingSize() != node_count) return {};
  return network.matched(matching);
}

std::vector<bool> heaviest_perfect_matching(int node_count, const std::vector<std::pair<int, int>>& edges,
                                            const std::vector<int>& weights) {
  const Network network(node_count, edges);
  Graph::EdgeMap<int> weight(network.graph);
  for (std::size_t e = 0; e < edges.size(); ++e) weight[network.edges[e]] = weights[e];
  lemon::MaxWeightedPerfectMatching<Graph> matching(network.graph, weight);
  if (!matching.run()) return {};
  return network.matched(matching);
}

}  // namespace unicursal::core
