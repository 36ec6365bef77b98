// A graph drawn in the plane, as half-edges. Half-edges 2e and 2e + 1 are the two directions of edge e; a
// face lies to the left of its half-edges. Parallel edges are allowed (a cell at a dead end has two sides).
#pragma once

#include <cstddef>
#include <vector>

#include "core/geometry/polygon.hpp"

namespace unicursal::core {

using NodeIndex = int;
using EdgeIndex = int;
using HalfEdgeIndex = int;
using FaceIndex = int;

inline constexpr FaceIndex outside = -1;

struct HalfEdge {
  NodeIndex origin = 0;
  HalfEdgeIndex next = -1;  ///< along the face to the left
  FaceIndex face = outside;
};

struct PlanarGraph {
  std::vector<Vec2> position;        ///< per node, mm
  std::vector<HalfEdge> half_edges;  ///< two per edge
  std::vector<Ring> via;             ///< per edge: bends on the way from half-edge 2e's origin; mostly empty
  std::vector<HalfEdgeIndex> face_start;  ///< per face, one of its half-edges

  std::size_t node_count() const { return position.size(); }
  std::size_t edge_count() const { return half_edges.size() / 2; }
  std::size_t face_count() const { return face_start.size(); }

  static HalfEdgeIndex twin(HalfEdgeIndex h) { return h ^ 1; }
  static EdgeIndex edge(HalfEdgeIndex h) { return h / 2; }
  NodeIndex origin(HalfEdgeIndex h) const { return half_edges[static_cast<std::size_t>(h)].origin; }
  NodeIndex target(HalfEdgeIndex h) const { return origin(twin(h)); }
  HalfEdgeIndex next(HalfEdgeIndex h) const { return half_edges[static_cast<std::size_t>(h)].next; }
  FaceIndex face(HalfEdgeIndex h) const { return half_edges[static_cast<std::size_t>(h)].face; }
  const Ring& bends(HalfEdgeIndex h) const { return via[static_cast<std::size_t>(edge(h))]; }

  /// Appends the bends of a half-edge in its own direction, without its ends.
  void append_bends(HalfEdgeIndex h, Ring& line) const;
  /// The face's outline, counter-clockwise, bends included.
  Ring outline(FaceIndex face) const;
};

}  // namespace unicursal::core
