// A Hamiltonian cycle of the refined graph that can be edited: who follows whom, and by which edge.
//
// The tour runs counter-clockwise, its inside on the left, and every local operation keeps it so: an
// operation turns triangles of the graph from inside to outside and back, the tour is the border between.
#pragma once

#include <functional>
#include <vector>

#include "core/curve/curve.hpp"
#include "core/graph/refined_graph.hpp"

namespace unicursal::core {

/// A visit of the tour to a node. Stops below the number of nodes are the nodes; a node on a doubled edge is
/// visited once more by a stop of higher number.
using StopIndex = int;

struct Tour {
  RefinedGraph graph;
  std::vector<Vec2> position;           ///< per stop, mm; the two stops of a doubled node stand beside it
  std::vector<StopIndex> next, before;  ///< per stop; −1 for a centre that the tour could not reach
  std::vector<HalfEdgeIndex> leave;     ///< per stop: the half-edge to the next stop; −1 as above
  std::vector<char> free;               ///< per stop: may be moved; not on doubled edges, nor when unreached

  std::size_t stop_count() const { return next.size(); }
  bool visited(StopIndex s) const { return next[static_cast<std::size_t>(s)] >= 0; }
};

/// What it costs to run straight from one point to another; may be negative. Empty: everything costs the
/// same.
using RunCost = std::function<double(const Vec2&, const Vec2&)>;

/// The tour as a curve, with the bends of its edges. Precondition: something is visited.
Curve drawn(const Tour& tour);

}  // namespace unicursal::core
