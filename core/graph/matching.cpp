// Compiled as C++17: LEMON 1.3 uses allocator members that C++20 removed.
#include "core/graph/matching.hpp"

#include <lemon/matching.h>
#include <lemon/smart_graph.h>

namespace unicursal::core {

std::vector<bool> perfect_matching(int node_count, const std::vector<std::pair<int, int>>& edges) {
  lemon::SmartGraph graph;
  graph.reserveNode(node_count);
  graph.reserveEdge(static_cast<int>(edges.size()));
  std::vector<lemon::SmartGraph::Node> nodes;
  nodes.reserve(static_cast<std::size_t>(node_count));
  for (int n = 0; n < node_count; ++n) nodes.push_back(graph.addNode());
  std::vector<lemon::SmartGraph::Edge> handles;
  handles.reserve(edges.size());
  for (const auto& [a, b] : edges) {
    handles.push_back(graph.addEdge(nodes[static_cast<std::size_t>(a)], nodes[static_cast<std::size_t>(b)]));
  }
  lemon::MaxMatching<lemon::SmartGraph> matching(graph);
  matching.run();
  if (2 * matching.matchingSize() != node_count) return {};
  std::vector<bool> matched(edges.size());
  for (std::size_t e = 0; e < edges.size(); ++e) matched[e] = matching.matching(handles[e]);
  return matched;
}

}  // namespace unicursal::core
