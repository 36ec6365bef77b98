#include "core/graph/planar_graph.hpp"

#include <utility>

namespace unicursal::core {

HalfEdgeIndex PlanarGraph::add_edge(NodeIndex a, NodeIndex b, Ring bends) {
  const HalfEdgeIndex h = half_edges.push_back({a, {}, outside});
  half_edges.push_back({b, {}, outside});
  via.push_back(std::move(bends));
  return h;
}

void PlanarGraph::append_bends(HalfEdgeIndex h, Ring& line) const {
  const Ring& points = bends(h);
  if (is_forward(h)) {
    line.insert(line.end(), points.begin(), points.end());
  } else {
    line.insert(line.end(), points.rbegin(), points.rend());
  }
}

Ring PlanarGraph::line(HalfEdgeIndex h) const {
  Ring points{position[origin(h)]};
  append_bends(h, points);
  points.push_back(position[target(h)]);
  return points;
}

Ring PlanarGraph::outline(FaceIndex face) const {
  Ring ring;
  const HalfEdgeIndex start = face_start[face];
  HalfEdgeIndex h = start;
  do {
    ring.push_back(position[origin(h)]);
    append_bends(h, ring);
    h = next(h);
  } while (h != start);
  return ring;
}

}  // namespace unicursal::core
