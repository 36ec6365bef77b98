// Checks that hold for every cell graph.
#pragma once

#include <catch2/catch.hpp>

#include "core/graph/cell_graph.hpp"

namespace unicursal::core::test {

/// Checks that every node has three edges, that every face is a disc to the left of its half-edges, and that
/// Euler's formula holds.
inline void check_cell_graph(const CellGraph& graph, const Polygon& domain) {
  Per<NodeIndex, int> degree(graph.node_count(), 0);
  for (const HalfEdge& half : graph.half_edges) ++degree[half.origin];
  for (const int d : degree) REQUIRE(d == 3);
  const auto nodes = static_cast<long>(graph.node_count()), edges = static_cast<long>(graph.edge_count());
  const auto faces = static_cast<long>(graph.face_count());
  // Connected, and the outside of each border ring counts as one face.
  REQUIRE(nodes - edges + faces + 1 + static_cast<long>(domain.holes.size()) == 2);
  double covered = 0;
  for (const FaceIndex f : graph.face_start.indices()) {
    const double piece = signed_area(graph.outline(f));
    REQUIRE(piece > 0);
    covered += piece;
  }
  REQUIRE(covered == Approx(area(domain)).epsilon(1e-9));
  for (const HalfEdgeIndex half : graph.half_edges.indices()) {
    REQUIRE(graph.face(graph.next(half)) == graph.face(half));
    // No bridge: the two sides of an edge are different cells.
    REQUIRE(graph.face(half) != graph.face(PlanarGraph::twin(half)));
  }
}

}  // namespace unicursal::core::test
