// A Hamiltonian cycle of the refined graph in a form that can be edited: for every stop its neighbours along
// the cycle and the half-edge that leads to the next one.
//
// The tour runs counter-clockwise, with its inside on the left. The refined graph's triangles lie either
// inside or outside; the tour is the border between them, and a local operation moves triangles from one side
// to the other (local_operations.hpp).
#pragma once

#include <functional>
#include <vector>

#include "core/curve/curve.hpp"
#include "core/graph/refined_graph.hpp"

namespace unicursal::core {

/// A visit of the tour to a node. The stops with the numbers of the nodes are the nodes' (first) visits; a
/// node on a doubled edge has a second visit, a stop of higher number.
using StopIndex = Index<struct StopTag>;

/// The (first) visit to a node.
inline StopIndex stop_at(NodeIndex node) {
  return StopIndex(node.number());
}

struct Tour {
  RefinedGraph graph;
  Per<StopIndex, Vec2> position;        ///< mm; the two stops of a doubled node stand on either side of it
  Per<StopIndex, StopIndex> next;       ///< the stop that follows; invalid at a centre that is not visited
  Per<StopIndex, StopIndex> before;     ///< the stop that precedes; invalid as above
  Per<StopIndex, HalfEdgeIndex> leave;  ///< the half-edge to the next stop; invalid as above
  Per<StopIndex, char> free;  ///< whether the stop may be moved; false on doubled edges and where not visited

  std::size_t stop_count() const { return next.size(); }
  bool visited(StopIndex s) const { return next[s].valid(); }
  /// Any visited stop; invalid if there is none.
  StopIndex first_visited() const {
    return next.first_with([](StopIndex s) { return s.valid(); });
  }
  std::size_t visited_count() const;
  /// All visited stops in the order of the tour.
  std::vector<StopIndex> sequence() const;
};

/// The cost of a straight run from one point to another; it may be negative. An empty function means that all
/// runs cost the same.
using RunCost = std::function<double(const Vec2&, const Vec2&)>;

/// The tour as a curve, with the bends of its edges. Precondition: at least one stop is visited.
Curve drawn(const Tour& tour);

}  // namespace unicursal::core
