// Measures whether the library's perfect matching grows linearly on cell graphs: LEMON's blossom method
// (used) beside Boost's, on squares of more and more cells.
#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/max_cardinality_matching.hpp>

#include <fmt/core.h>

#include <chrono>
#include <utility>
#include <vector>

#include "core/graph/cell_graph.hpp"
#include "core/graph/matching.hpp"

namespace {

using namespace unicursal::core;

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::size_t boost_matching(std::size_t nodes, const Per<EdgeIndex, EdgeEnds>& ends) {
  std::vector<std::pair<std::size_t, std::size_t>> edges;
  for (const auto& [a, b] : ends) edges.emplace_back(a.number(), b.number());
  using Graph = boost::adjacency_list<boost::vecS, boost::vecS, boost::undirectedS>;
  Graph graph(edges.begin(), edges.end(), nodes);
  std::vector<boost::graph_traits<Graph>::vertex_descriptor> mate(nodes);
  boost::edmonds_maximum_cardinality_matching(graph, &mate[0]);
  return boost::matching_size(graph, &mate[0]);
}

}  // namespace

int main() {
  for (const double side : {30.0, 60.0, 120.0, 240.0, 480.0}) {
    Random random(1);
    const auto graph = make_cell_graph({{{0, 0}, {side, 0}, {side, side}, {0, side}}, {}}, 1.0, random);
    if (!graph) continue;
    Per<EdgeIndex, EdgeEnds> edges;
    for (const EdgeIndex e : graph->edges()) {
      const HalfEdgeIndex h = PlanarGraph::forward(e);
      edges.push_back({graph->origin(h), graph->target(h)});
    }
    const std::size_t nodes = graph->node_count();
    auto start = std::chrono::steady_clock::now();
    const bool perfect = !perfect_matching(nodes, edges).empty();
    const double lemon = seconds_since(start);
    fmt::print("nodes {:7}  LEMON {:.4f} s ({:.2f} µs a node, {})", nodes, lemon,
               1e6 * lemon / static_cast<double>(nodes), perfect ? "perfect" : "NOT PERFECT");
    if (nodes < 40000) {
      start = std::chrono::steady_clock::now();
      const std::size_t matched = boost_matching(nodes, edges);
      const double boost = seconds_since(start);
      fmt::print("  Boost {:.4f} s ({:.2f} µs a node, {} of {})", boost,
                 1e6 * boost / static_cast<double>(nodes), 2 * matched, nodes);
    }
    fmt::print("\n");
  }
}
