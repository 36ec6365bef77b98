#include "core/graph/planar_graph.hpp"

namespace unicursal::core {

void PlanarGraph::append_bends(HalfEdgeIndex h, Ring& line) const {
  const Ring& points = bends(h);
  if (h % 2 == 0) {
    line.insert(line.end(), points.begin(), points.end());
  } else {
    line.insert(line.end(), points.rbegin(), points.rend());
  }
}

Ring PlanarGraph::outline(FaceIndex face) const {
  Ring ring;
  const HalfEdgeIndex start = face_start[static_cast<std::size_t>(face)];
  HalfEdgeIndex h = start;
  do {
    ring.push_back(position[static_cast<std::size_t>(origin(h))]);
    append_bends(h, ring);
    h = next(h);
  } while (h != start);
  return ring;
}

}  // namespace unicursal::core
