#include "core/graph/needle_diagram.hpp"

#include <algorithm>
#include <array>

#include "core/geometry/predicates.hpp"

namespace unicursal::core {
namespace {

constexpr int points_per_needle = 5;

/// Joins the edges of a diagram into chains from node to node. A node is a vertex where three groups meet.
class Merger {
 public:
  Merger(const Voronoi& fine, const Per<CellIndex, CellIndex>& group) : fine_(fine), group_(group) {
    groups_ = group.empty() ? 0 : std::max_element(group.begin(), group.end())->number() + 1;
  }

  std::optional<Voronoi> run() {
    find_nodes();
    for (const VoronoiVertexIndex v : fine_.vertices.indices()) {
      if (!node_of_[v].valid()) continue;
      for (const VoronoiEdgeIndex e : fine_.vertices[v].edges) follow(v, e);
    }
    for (const VoronoiEdgeIndex e : fine_.edges.indices()) {
      if (kept(e) && !chain_of_[e].valid()) return std::nullopt;
    }
    connect();
    return std::move(result_);
  }

 private:
  CellIndex group_of(CellIndex cell) const {
    const std::size_t c = cell.number();
    return c < group_.size() ? group_[cell] : CellIndex(groups_ + (c - group_.size()));
  }
  const VoronoiEdge& edge(VoronoiEdgeIndex e) const { return fine_.edges[e]; }

  /// Edges to infinity (invalid) lie between far sites, each of which is a group of its own.
  bool kept(VoronoiEdgeIndex e) const {
    return !e.valid() || group_of(edge(e).left) != group_of(edge(e).right);
  }

  void find_nodes() {
    node_of_.resize(fine_.vertices.size());
    chain_of_.resize(fine_.edges.size());
    for (const VoronoiVertexIndex v : fine_.vertices.indices()) {
      const auto& edges = fine_.vertices[v].edges;
      if (!std::all_of(edges.begin(), edges.end(), [&](VoronoiEdgeIndex e) { return kept(e); })) continue;
      node_of_[v] = result_.vertices.push_back({fine_.vertices[v].position, {}});
    }
  }

  /// Adds the chain that leaves node `v` by edge `e`, unless it was added from its other end.
  void follow(VoronoiVertexIndex v, VoronoiEdgeIndex e) {
    if (!e.valid() || chain_of_[e].valid()) return;
    const bool forward = edge(e).from == v;
    VoronoiEdge chain;
    chain.left = group_of(forward ? edge(e).left : edge(e).right);
    chain.right = group_of(forward ? edge(e).right : edge(e).left);
    chain.from = node_of_[v];
    for (;;) {
      chain_of_[e] = VoronoiEdgeIndex(result_.edges.size());
      v = edge(e).from == v ? edge(e).to : edge(e).from;
      if (node_of_[v].valid()) break;
      chain.via.push_back(fine_.vertices[v].position);
      const auto& around = fine_.vertices[v].edges;
      e = *std::find_if(around.begin(), around.end(),
                        [&](VoronoiEdgeIndex other) { return other != e && kept(other); });
    }
    chain.to = node_of_[v];
    result_.edges.push_back(std::move(chain));
  }

  void connect() {
    for (const VoronoiVertexIndex v : fine_.vertices.indices()) {
      if (!node_of_[v].valid()) continue;
      auto& around = result_.vertices[node_of_[v]].edges;
      for (std::size_t i = 0; i < 3; ++i) {
        const VoronoiEdgeIndex e = fine_.vertices[v].edges[i];
        if (e.valid()) around[i] = chain_of_[e];
      }
    }
  }

  const Voronoi& fine_;
  const Per<CellIndex, CellIndex>& group_;
  std::size_t groups_ = 0;
  /// The node at a vertex of the fine diagram; invalid where fewer than three groups meet.
  Per<VoronoiVertexIndex, VoronoiVertexIndex> node_of_;
  /// The chain that an edge of the fine diagram belongs to.
  Per<VoronoiEdgeIndex, VoronoiEdgeIndex> chain_of_;
  Voronoi result_;
};

/// Whether two segments have more in common than one end. Exact.
bool meet(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  if (a == c || a == d || b == c || b == d) {
    if ((a == c && b == d) || (a == d && b == c)) return true;
    const Vec2& shared = a == c || a == d ? a : b;
    const Vec2 &p = shared == a ? b : a, &q = shared == c ? d : c;
    return orientation(shared, p, q) == 0 && (p - shared).dot(q - shared) > 0;
  }
  return orientation(a, b, c) * orientation(a, b, d) <= 0 && orientation(c, d, a) * orientation(c, d, b) <= 0;
}

class Straightener {
 public:
  Straightener(Voronoi& diagram, std::size_t cells) : diagram_(diagram), sides_(cells) {
    bent_.assign(diagram.edges.size(), false);
    for (const VoronoiEdgeIndex e : diagram.edges.indices()) {
      for (const CellIndex cell : {diagram.edges[e].left, diagram.edges[e].right}) {
        if (cell.number() < cells) sides_[cell].push_back(e);
      }
    }
  }

  void run() {
    std::vector<CellIndex> open;
    for (const CellIndex cell : sides_.indices()) open.push_back(cell);
    while (!open.empty()) {
      const CellIndex cell = open.back();
      open.pop_back();
      if (!sound(cell)) bend(cell, open);
    }
    for (const VoronoiEdgeIndex e : bent_.indices()) {
      if (!bent_[e]) diagram_.edges[e].via.clear();
    }
  }

 private:
  const Vec2& start(VoronoiEdgeIndex e) const { return diagram_.vertices[diagram_.edges[e].from].position; }

  /// The edge as it is drawn now, both ends included.
  Ring line(VoronoiEdgeIndex e) const {
    Ring points{start(e)};
    const VoronoiEdge& edge = diagram_.edges[e];
    if (bent_[e]) points.insert(points.end(), edge.via.begin(), edge.via.end());
    points.push_back(diagram_.vertices[edge.to].position);
    return points;
  }

  /// Whether the cell is a simple polygon that runs counter-clockwise. If all cells are, the drawing is
  /// plane: the winding numbers of all cells about a point add up to one.
  bool sound(CellIndex cell) const {
    if (sides_[cell].empty()) return true;  // two needles in one place share the other's cell
    std::vector<std::array<Vec2, 2>> pieces;
    const Vec2 about = start(sides_[cell].front());
    double twice = 0;
    for (const VoronoiEdgeIndex e : sides_[cell]) {
      const Ring points = line(e);
      const double sign = diagram_.edges[e].left == cell ? 1 : -1;
      for (std::size_t k = 0; k + 1 < points.size(); ++k) {
        pieces.push_back({points[k], points[k + 1]});
        twice += sign * cross(points[k] - about, points[k + 1] - about);
      }
    }
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        if (meet(pieces[i][0], pieces[i][1], pieces[j][0], pieces[j][1])) return false;
      }
    }
    return twice > 0;
  }

  /// Draws all sides of the cell with their bends; the cell and its neighbours must then be checked again.
  void bend(CellIndex cell, std::vector<CellIndex>& open) {
    for (const VoronoiEdgeIndex e : sides_[cell]) {
      if (bent_[e] || diagram_.edges[e].via.empty()) continue;
      bent_[e] = true;
      for (const CellIndex side : {diagram_.edges[e].left, diagram_.edges[e].right}) {
        if (side.number() < sides_.size()) open.push_back(side);
      }
    }
  }

  Voronoi& diagram_;
  Per<CellIndex, std::vector<VoronoiEdgeIndex>> sides_;  ///< the edges of a cell
  Per<VoronoiEdgeIndex, bool> bent_;                     ///< the edge is drawn with its bends
};

}  // namespace

std::optional<Voronoi> merged(const Voronoi& diagram, const Per<CellIndex, CellIndex>& group) {
  return Merger(diagram, group).run();
}

void straighten(Voronoi& diagram, std::size_t cells) {
  Straightener(diagram, cells).run();
}

std::optional<Voronoi> needle_diagram(const std::vector<Segment>& needles, const Box& box) {
  std::vector<Vec2> points;
  Per<CellIndex, CellIndex> needle;
  for (std::size_t i = 0; i < needles.size(); ++i) {
    const auto& [a, b] = needles[i];
    const int count = a == b ? 1 : points_per_needle;
    for (int k = 0; k < count; ++k) {
      points.push_back(count == 1 ? a : Vec2(a + k / (count - 1.0) * (b - a)));
      needle.push_back(CellIndex(i));
    }
  }
  std::optional<Voronoi> diagram = merged(voronoi(points, box), needle);
  if (diagram) straighten(*diagram, needles.size());
  return diagram;
}

}  // namespace unicursal::core
