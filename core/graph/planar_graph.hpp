// A graph drawn in the plane, as half-edges. Each edge e consists of two half-edges, forward(e) and
// backward(e), which are each other's twins and run in opposite directions. A face lies to the left of its
// half-edges. Parallel edges are allowed (a cell at a dead end has two sides).
#pragma once

#include <cstddef>

#include "core/geometry/polygon.hpp"
#include "core/graph/index.hpp"

namespace unicursal::core {

/// The face of half-edges that have no cell to their left.
inline constexpr FaceIndex outside;

struct HalfEdge {
  NodeIndex origin;
  HalfEdgeIndex next;  ///< the next half-edge along the face to the left
  FaceIndex face = outside;
};

struct PlanarGraph {
  Per<NodeIndex, Vec2> position;             ///< mm
  Per<HalfEdgeIndex, HalfEdge> half_edges;   ///< forward and backward half-edges alternate
  Per<EdgeIndex, Ring> via;                  ///< bends of the edge, in forward direction; mostly empty
  Per<FaceIndex, HalfEdgeIndex> face_start;  ///< one half-edge of the face

  std::size_t node_count() const { return position.size(); }
  std::size_t edge_count() const { return half_edges.size() / 2; }
  std::size_t face_count() const { return face_start.size(); }
  IndexRange<EdgeIndex> edges() const { return IndexRange<EdgeIndex>(edge_count()); }

  static HalfEdgeIndex forward(EdgeIndex e) { return HalfEdgeIndex(2 * e.number()); }
  static HalfEdgeIndex backward(EdgeIndex e) { return HalfEdgeIndex(2 * e.number() + 1); }
  static bool is_forward(HalfEdgeIndex h) { return h.number() % 2 == 0; }
  static EdgeIndex edge(HalfEdgeIndex h) { return EdgeIndex(h.number() / 2); }
  static HalfEdgeIndex twin(HalfEdgeIndex h) { return HalfEdgeIndex(h.number() ^ 1U); }

  NodeIndex origin(HalfEdgeIndex h) const { return half_edges[h].origin; }
  NodeIndex target(HalfEdgeIndex h) const { return origin(twin(h)); }
  HalfEdgeIndex next(HalfEdgeIndex h) const { return half_edges[h].next; }
  FaceIndex face(HalfEdgeIndex h) const { return half_edges[h].face; }
  const Ring& bends(HalfEdgeIndex h) const { return via[edge(h)]; }

  /// Adds an edge from `a` to `b`, without faces or successors. Returns its forward half-edge.
  HalfEdgeIndex add_edge(NodeIndex a, NodeIndex b, Ring bends = {});

  /// Appends the bends of a half-edge in its own direction, without its ends.
  void append_bends(HalfEdgeIndex h, Ring& line) const;
  /// The half-edge as it is drawn: its origin, its bends, its target.
  Ring line(HalfEdgeIndex h) const;
  /// The face's outline, counter-clockwise, bends included.
  Ring outline(FaceIndex face) const;
};

}  // namespace unicursal::core
