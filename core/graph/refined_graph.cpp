#include "core/graph/refined_graph.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace unicursal::core {
namespace {

// A smaller kernel, as a share of the cell's area, would pinch the curve.
constexpr double least_kernel = 1e-4;
// Least distance of a centre from the lines of the outline, as a share of the cell's size.
constexpr double least_sight = 1e-3;

Vec2 centroid(const Ring& ring) {
  const Vec2 about = ring.front();
  Vec2 moment(0, 0);
  double twice = 0;
  for (std::size_t i = 1; i + 1 < ring.size(); ++i) {
    const Vec2 a = ring[i] - about, b = ring[i + 1] - about;
    moment += cross(a, b) * (a + b);
    twice += cross(a, b);
  }
  return about + moment / (3 * twice);
}

bool sees_all(const Ring& ring, const Vec2& point, double margin) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2 &a = ring[i], &b = ring[(i + 1) % ring.size()];
    if (cross(b - a, point - a) <= margin * (b - a).norm()) return false;
  }
  return true;
}

/// The points from which the whole ring is visible: the intersection of the half-planes left of its edges.
Ring kernel(const Ring& ring) {
  const Box box = bounds(ring);
  Ring region{box.min, {box.max.x(), box.min.y()}, box.max, {box.min.x(), box.max.y()}};
  for (std::size_t i = 0; i < ring.size() && region.size() >= 3; ++i) {
    const Vec2 &a = ring[i], &b = ring[(i + 1) % ring.size()];
    if (a == b) continue;
    Ring kept;
    for (std::size_t k = 0; k < region.size(); ++k) {
      const Vec2 &p = region[k], &q = region[(k + 1) % region.size()];
      const double hp = cross(b - a, p - a), hq = cross(b - a, q - a);
      if (hp >= 0) kept.push_back(p);
      if ((hp >= 0) != (hq >= 0)) kept.push_back(p + hp / (hp - hq) * (q - p));
    }
    region.swap(kept);
  }
  return region;
}

std::optional<Vec2> centre_of(const Ring& cell) {
  const double cell_area = signed_area(cell);
  const double margin = least_sight * std::sqrt(cell_area);
  const Vec2 middle = centroid(cell);
  if (sees_all(cell, middle, margin)) return middle;
  const Ring region = kernel(cell);
  if (region.size() < 3 || signed_area(region) < least_kernel * cell_area) return std::nullopt;
  const Vec2 candidate = centroid(region);
  if (!sees_all(cell, candidate, 0)) return std::nullopt;
  return candidate;
}

/// Joins the centre to every node of the cell, which makes a triangle of each side.
void split_cell(RefinedGraph& graph, FaceIndex cell, const Vec2& centre) {
  const NodeIndex node = graph.position.push_back(centre);
  graph.centre[cell] = node;
  std::vector<HalfEdgeIndex> sides;
  const HalfEdgeIndex start = graph.face_start[cell];
  HalfEdgeIndex h = start;
  do {
    sides.push_back(h);
    h = graph.next(h);
  } while (h != start);
  // Spoke i leads from the centre to the origin of side i.
  std::vector<HalfEdgeIndex> spokes;
  for (const HalfEdgeIndex side : sides) spokes.push_back(graph.add_edge(node, graph.origin(side)));
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const HalfEdgeIndex side = sides[i];
    const HalfEdgeIndex out = spokes[i];
    const HalfEdgeIndex back = PlanarGraph::twin(spokes[(i + 1) % spokes.size()]);
    const FaceIndex face = i == 0 ? cell : graph.face_start.push_back(side);
    const HalfEdgeIndex triangle[3] = {side, back, out};
    for (int k = 0; k < 3; ++k) {
      HalfEdge& half = graph.half_edges[triangle[k]];
      half.next = triangle[(k + 1) % 3];
      half.face = face;
    }
  }
}

}  // namespace

RefinedGraph refine(const CellGraph& cells) {
  RefinedGraph graph{cells, cells.node_count(), cells.edge_count(), {}};
  graph.centre.resize(cells.face_count());
  for (const FaceIndex cell : cells.face_start.indices()) {
    if (const std::optional<Vec2> centre = centre_of(cells.outline(cell))) split_cell(graph, cell, *centre);
  }
  return graph;
}

}  // namespace unicursal::core
