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
  Per<EdgeIndex, Graph::Edge> edges;

  Network(std::size_t node_count, const Per<EdgeIndex, EdgeEnds>& pairs) {
    graph.reserveNode(static_cast<int>(node_count));
    graph.reserveEdge(static_cast<int>(pairs.size()));
    Per<NodeIndex, Graph::Node> nodes;
    nodes.reserve(node_count);
    for (std::size_t n = 0; n < node_count; ++n) nodes.push_back(graph.addNode());
    edges.reserve(pairs.size());
    for (const EdgeEnds& ends : pairs) edges.push_back(graph.addEdge(nodes[ends.first], nodes[ends.second]));
  }

  template <typename Matching>
  Per<EdgeIndex, bool> matched(const Matching& matching) const {
    Per<EdgeIndex, bool> result(edges.size());
    for (const EdgeIndex e : edges.indices()) result[e] = matching.matching(edges[e]);
    return result;
  }
};

}  // namespace

Per<EdgeIndex, bool> perfect_matching(std::size_t node_count, const Per<EdgeIndex, EdgeEnds>& edges) {
  const Network network(node_count, edges);
  lemon::MaxMatching<Graph> matching(network.graph);
  matching.run();
  if (2 * matching.matchingSize() != static_cast<int>(node_count)) return {};
  return network.matched(matching);
}

Per<EdgeIndex, bool> heaviest_perfect_matching(std::size_t node_count, const Per<EdgeIndex, EdgeEnds>& edges,
                                               const Per<EdgeIndex, int>& weights) {
  const Network network(node_count, edges);
  Graph::EdgeMap<int> weight(network.graph);
  for (const EdgeIndex e : edges.indices()) weight[network.edges[e]] = weights[e];
  lemon::MaxWeightedPerfectMatching<Graph> matching(network.graph, weight);
  if (!matching.run()) return {};
  return network.matched(matching);
}

}  // namespace unicursal::core
