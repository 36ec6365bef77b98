#include "core/graph/needle_diagram.hpp"
#include "core/geometry/predicates.hpp"

#include <algorithm>
#include <array>

namespace unicursal::core {
namespace {

constexpr int points_per_needle = 5;

/// Joins the edges of a diagram into chains from node to node, a node being where three groups meet.
class Merger {
 public:
  Merger(const Voronoi& fine, const std::vector<int>& group) : fine_(fine), group_(group) {
    groups_ = group.empty() ? 0 : *std::max_element(group.begin(), group.end()) + 1;
  }

  std::optional<Voronoi> run() {
    find_nodes();
    for (std::size_t v = 0; v < fine_.vertices.size(); ++v) {
      if (node_of_[v] < 0) continue;
      for (std::size_t i = 0; i < 3; ++i) follow(static_cast<int>(v), fine_.vertices[v].edges[i]);
    }
    for (std::size_t e = 0; e < fine_.edges.size(); ++e) {
      if (kept(static_cast<int>(e)) && chain_of_[e] < 0) return std::nullopt;
    }
    connect();
    return std::move(result_);
  }

 private:
  int group_of(int site) const {
    const auto s = static_cast<std::size_t>(site);
    return s < group_.size() ? group_[s] : groups_ + static_cast<int>(s - group_.size());
  }
  const VoronoiEdge& edge(int e) const { return fine_.edges[static_cast<std::size_t>(e)]; }
  const VoronoiVertex& vertex(int v) const { return fine_.vertices[static_cast<std::size_t>(v)]; }

  /// Edges to infinity (−1) lie between far sites, each of which is a group of its own.
  bool kept(int e) const { return e < 0 || group_of(edge(e).left) != group_of(edge(e).right); }

  void find_nodes() {
    node_of_.assign(fine_.vertices.size(), -1);
    chain_of_.assign(fine_.edges.size(), -1);
    for (std::size_t v = 0; v < fine_.vertices.size(); ++v) {
      const VoronoiVertex& vertex = fine_.vertices[v];
      if (!std::all_of(vertex.edges.begin(), vertex.edges.end(), [&](int e) { return kept(e); })) continue;
      node_of_[v] = static_cast<int>(result_.vertices.size());
      result_.vertices.push_back({vertex.position, {-1, -1, -1}});
    }
  }

  /// The chain that leaves node `v` by edge `e`, unless it came in from its other end.
  void follow(int v, int e) {
    if (e < 0 || chain_of_[static_cast<std::size_t>(e)] >= 0) return;
    const bool forward = edge(e).from == v;
    VoronoiEdge chain;
    chain.left = group_of(forward ? edge(e).left : edge(e).right);
    chain.right = group_of(forward ? edge(e).right : edge(e).left);
    chain.from = node_of_[static_cast<std::size_t>(v)];
    for (;;) {
      chain_of_[static_cast<std::size_t>(e)] = static_cast<int>(result_.edges.size());
      v = edge(e).from == v ? edge(e).to : edge(e).from;
      if (node_of_[static_cast<std::size_t>(v)] >= 0) break;
      chain.via.push_back(vertex(v).position);
      const auto& around = vertex(v).edges;
      e = *std::find_if(around.begin(), around.end(), [&](int other) { return other != e && kept(other); });
    }
    chain.to = node_of_[static_cast<std::size_t>(v)];
    result_.edges.push_back(std::move(chain));
  }

  void connect() {
    for (std::size_t v = 0; v < fine_.vertices.size(); ++v) {
      if (node_of_[v] < 0) continue;
      auto& around = result_.vertices[static_cast<std::size_t>(node_of_[v])].edges;
      for (std::size_t i = 0; i < 3; ++i) {
        const int e = fine_.vertices[v].edges[i];
        around[i] = e < 0 ? -1 : chain_of_[static_cast<std::size_t>(e)];
      }
    }
  }

  const Voronoi& fine_;
  const std::vector<int>& group_;
  int groups_ = 0;
  std::vector<int> node_of_;   ///< per vertex of the fine diagram, −1 where fewer than three groups meet
  std::vector<int> chain_of_;  ///< per edge of the fine diagram
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
    for (std::size_t e = 0; e < diagram.edges.size(); ++e) {
      for (const int cell : {diagram.edges[e].left, diagram.edges[e].right}) {
        if (static_cast<std::size_t>(cell) < cells) sides_[static_cast<std::size_t>(cell)].push_back(e);
      }
    }
  }

  void run() {
    std::vector<std::size_t> open;
    for (std::size_t cell = 0; cell < sides_.size(); ++cell) open.push_back(cell);
    while (!open.empty()) {
      const std::size_t cell = open.back();
      open.pop_back();
      if (!sound(cell)) bend(cell, open);
    }
    for (std::size_t e = 0; e < bent_.size(); ++e) {
      if (!bent_[e]) diagram_.edges[e].via.clear();
    }
  }

 private:
  const Vec2& start(std::size_t e) const {
    return diagram_.vertices[static_cast<std::size_t>(diagram_.edges[e].from)].position;
  }

  /// The edge as it is drawn now, both ends included.
  Ring line(std::size_t e) const {
    Ring points{start(e)};
    const VoronoiEdge& edge = diagram_.edges[e];
    if (bent_[e]) points.insert(points.end(), edge.via.begin(), edge.via.end());
    points.push_back(diagram_.vertices[static_cast<std::size_t>(edge.to)].position);
    return points;
  }

  /// A simple polygon that runs counter-clockwise. When all cells are, the drawing is plane: the winding
  /// numbers of all cells about a point add up to one.
  bool sound(std::size_t cell) const {
    if (sides_[cell].empty()) return true;  // two needles in one place share the other's cell
    std::vector<std::array<Vec2, 2>> pieces;
    const Vec2 about = start(sides_[cell].front());
    double twice = 0;
    for (const std::size_t e : sides_[cell]) {
      const Ring points = line(e);
      const double sign = diagram_.edges[e].left == static_cast<int>(cell) ? 1 : -1;
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

  /// Draws all sides of the cell with their bends; it and its neighbours must then be looked at again.
  void bend(std::size_t cell, std::vector<std::size_t>& open) {
    for (const std::size_t e : sides_[cell]) {
      if (bent_[e] || diagram_.edges[e].via.empty()) continue;
      bent_[e] = true;
      for (const int side : {diagram_.edges[e].left, diagram_.edges[e].right}) {
        if (static_cast<std::size_t>(side) < sides_.size()) open.push_back(static_cast<std::size_t>(side));
      }
    }
  }

  Voronoi& diagram_;
  std::vector<std::vector<std::size_t>> sides_;  ///< per cell its edges
  std::vector<bool> bent_;                       ///< per edge, drawn with its bends
};

}  // namespace

std::optional<Voronoi> merged(const Voronoi& diagram, const std::vector<int>& group) {
  return Merger(diagram, group).run();
}

void straighten(Voronoi& diagram, std::size_t cells) {
  Straightener(diagram, cells).run();
}

std::optional<Voronoi> needle_diagram(const std::vector<Segment>& needles, const Box& box) {
  std::vector<Vec2> points;
  std::vector<int> needle;
  for (std::size_t i = 0; i < needles.size(); ++i) {
    const auto& [a, b] = needles[i];
    const int count = a == b ? 1 : points_per_needle;
    for (int k = 0; k < count; ++k) {
      points.push_back(count == 1 ? a : Vec2(a + k / (count - 1.0) * (b - a)));
      needle.push_back(static_cast<int>(i));
    }
  }
  std::optional<Voronoi> diagram = merged(voronoi(points, box), needle);
  if (diagram) straighten(*diagram, needles.size());
  return diagram;
}

}  // namespace unicursal::core
