#include "core/geometry/piece_diagram.hpp"

#include <CGAL/Random.h>
#include <CGAL/Segment_Delaunay_graph_2.h>
#include <CGAL/Segment_Delaunay_graph_filtered_traits_2.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "core/stopping.hpp"

namespace unicursal::core {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Traits = CGAL::Segment_Delaunay_graph_filtered_traits_without_intersections_2<Kernel>;
using Graph = CGAL::Segment_Delaunay_graph_2<Traits>;

constexpr int most_polishing_steps = 8;
constexpr int most_restarts = 6;
// A vertex that polishing moves farther, as a share of its distance from its sites, is checked more strictly.
constexpr double most_polishing_move = 1e-3;
// Greatest difference of the distances of a vertex from its three sites, mm.
constexpr double vertex_tolerance = 1e-8;
// Least sine of the angle between two borders whose meeting point is improved.
constexpr double least_turn = 1e-12;
// Neighbouring segments that do not turn back: least squared length of the sum of their directions.
constexpr double least_mean = 0.99;
constexpr double far_away = 20;  ///< box diagonals from the segments to the points that close their diagram

CellBorder ordered(const CellBorder& b) {
  return b.left < b.right ? b : CellBorder{b.right, b.left, b.to, b.from};
}

bool comes_first(const CellBorder& a, const CellBorder& b) {
  return std::make_tuple(a.left, a.right, a.from.x(), a.from.y(), a.to.x()) <
         std::make_tuple(b.left, b.right, b.from.x(), b.from.y(), b.to.x());
}

std::uint64_t key_of(double x, double y) {
  std::uint64_t a = 0, b = 0;
  x += 0.0, y += 0.0;  // turns −0 into 0
  std::memcpy(&a, &x, sizeof a);
  std::memcpy(&b, &y, sizeof b);
  return (a * 0x9E3779B97F4A7C15ULL) ^ (b + 0x7F4A7C15F39CC060ULL + (a << 6));
}

/// Four points far away close the diagram; as sites, their indices follow those of the curve's vertices.
class PieceDiagram {
 public:
  PieceDiagram(const CurveSites& sites, const std::vector<std::size_t>& segments)
      : sites_(sites), near_(segments), vertices_(vertices_of(sites, segments)) {}

  std::vector<CellBorder> run() {
    stop_point();
    // CGAL shuffles what it inserts; the order must not depend on earlier work.
    CGAL::get_default_random() = CGAL::Random(0);
    Graph graph;
    insert(graph);
    std::unordered_map<const void*, Vec2> centre;
    for (auto face = graph.finite_faces_begin(); face != graph.finite_faces_end(); ++face) {
      centre.emplace(&*face, vertex_of(graph, face));
    }
    std::vector<CellBorder> borders;
    for (auto edge = graph.finite_edges_begin(); edge != graph.finite_edges_end(); ++edge) {
      const auto face = edge->first;
      const auto other = face->neighbor(edge->second);
      if (graph.is_infinite(face) || graph.is_infinite(other)) continue;
      const CurveSite left = site_of(face->vertex(Graph::ccw(edge->second))->site());
      const CurveSite right = site_of(face->vertex(Graph::cw(edge->second))->site());
      // The borders of a far point's cell lie outside the island.
      if (left.index < sites_.size() && right.index < sites_.size())
        borders.push_back(ordered({left, right, centre.at(&*other), centre.at(&*face)}));
    }
    // CGAL's order depends on addresses; sums must not.
    std::sort(borders.begin(), borders.end(), comes_first);
    return borders;
  }

 private:
  void insert(Graph& graph) {
    std::vector<Kernel::Point_2> points;
    std::vector<std::pair<std::size_t, std::size_t>> ends;
    const Ring& curve = sites_.curve();
    Box box{curve[near_[0]], curve[near_[0]]};
    for (const std::size_t i : vertices_) {
      points.emplace_back(curve[i].x(), curve[i].y());
      vertex_at_.emplace(key_of(curve[i].x(), curve[i].y()), i);
      box.min = box.min.cwiseMin(curve[i]);
      box.max = box.max.cwiseMax(curve[i]);
    }
    for (const std::size_t i : near_) ends.emplace_back(place(i), place(sites_.after(i)));
    graph.insert_segments(points.begin(), points.end(), ends.begin(), ends.end());
    const double far = far_away * (box.size().norm() + 1);
    for (const Vec2& way : {Vec2(1, 0.1), Vec2(-0.1, 1), Vec2(-1, -0.1), Vec2(0.1, -1)}) {
      const Vec2 p = box.center() + far * way;
      vertex_at_.emplace(key_of(p.x(), p.y()), sites_.size() + far_.size());
      far_.push_back(p);
      graph.insert(Graph::Site_2::construct_site_2({p.x(), p.y()}));
    }
  }

  const Vec2& point(std::size_t index) const {
    return index < sites_.size() ? sites_.curve()[index] : far_[index - sites_.size()];
  }

  std::size_t vertex_at(const Kernel::Point_2& p) const {
    const auto [first, last] = vertex_at_.equal_range(key_of(p.x(), p.y()));
    const auto found =
        std::find_if(first, last, [&](const auto& v) { return point(v.second) == Vec2(p.x(), p.y()); });
    assert(found != last);
    return found->second;
  }

  CurveSite site_of(const Graph::Site_2& site) const {
    if (site.is_point()) return {vertex_at(site.point()), false};
    const std::size_t a = vertex_at(site.source()), b = vertex_at(site.target());
    return {sites_.after(a) == b ? a : b, true};
  }

  /// The place of a vertex in `vertices_`.
  std::size_t place(std::size_t vertex) const {
    const auto found = std::lower_bound(vertices_.begin(), vertices_.end(), vertex);
    return static_cast<std::size_t>(found - vertices_.begin());
  }

  /// By how much the distances from two sites differ, or a distance itself, mm; with its gradient.
  struct Residual {
    double value;
    Vec2 gradient;
  };

  Residual distance_of(const CurveSite& site, const Vec2& p) const {
    const Vec2 off = p - point(site.index);
    if (!site.segment) {
      const double d = off.norm();
      return {d, d > 0 ? Vec2(off / d) : Vec2(0, 0)};
    }
    const Vec2 n = perpendicular(sites_.direction(site.index));
    const double h = off.dot(n);
    return h >= 0 ? Residual{h, n} : Residual{-h, -n};
  }

  Residual difference(const CurveSite& l, const CurveSite& r, const Vec2& p) const {
    // The border of two sites with a common end is the line at right angles to the curve there, however
    // little the curve turns.
    const std::optional<Joint> end = joint(l, r);
    if (end && end->direction.squaredNorm() > least_mean) {
      const Vec2 unit = end->direction.normalized();
      return {(p - end->end).dot(unit), unit};
    }
    const Residual a = distance_of(l, p), b = distance_of(r, p);
    return {a.value - b.value, a.gradient - b.gradient};
  }

  struct Vertex {
    Vec2 position{0, 0};
    double error = 0;  ///< greatest difference of the three distances, mm
  };

  /// Improves a vertex by Newton's method. CGAL's vertices are rounded, and badly so where three sites nearly
  /// line up. Each step uses the two of the three conditions whose gradients differ most: neighbours that
  /// hardly turn act like a single site on any third one.
  Vertex polished(Vec2 p, const CurveSite& a, const CurveSite& b, const CurveSite& c) const {
    Vertex best{p, std::numeric_limits<double>::infinity()};
    for (int step = 0; step < most_polishing_steps && p.allFinite(); ++step) {
      const std::array all{difference(a, b, p), difference(b, c, p), difference(c, a, p)};
      double error = 0, determinant = 0;
      std::size_t first = 0;
      for (std::size_t k = 0; k < all.size(); ++k) {
        error = std::max(error, std::abs(all[k].value));
        const double turn = cross(all[k].gradient, all[(k + 1) % 3].gradient);
        if (std::abs(turn) > std::abs(determinant)) determinant = turn, first = k;
      }
      if (!(error < best.error)) break;
      best = {p, error};
      if (std::abs(determinant) < least_turn) break;
      const Residual &r = all[first], &s = all[(first + 1) % 3];
      p -= Vec2(r.value * s.gradient.y() - s.value * r.gradient.y(),
                s.value * r.gradient.x() - r.value * s.gradient.x()) /
           determinant;
    }
    return best;
  }

  Vec2 nearest_point(const CurveSite& site, const Vec2& p) const {
    return site.index < sites_.size() ? sites_.nearest_point(site, p) : point(site.index);
  }

  double distance(const CurveSite& site, const Vec2& p) const { return (nearest_point(site, p) - p).norm(); }

  /// Whether the sites themselves are equally far, not only the lines through them.
  bool meets(const Vertex& v, const std::array<CurveSite, 3>& sites) const {
    if (!(v.error < vertex_tolerance) || !v.position.allFinite()) return false;
    const double own = distance(sites[0], v.position);
    return std::abs(distance(sites[1], v.position) - own) < 2 * vertex_tolerance &&
           std::abs(distance(sites[2], v.position) - own) < 2 * vertex_tolerance;
  }

  /// Whether, in addition, no other site is nearer.
  bool is_vertex(const Vertex& v, const std::array<CurveSite, 3>& sites) const {
    return meets(v, sites) && distance(sites_.nearest(v.position), v.position) >
                                  distance(sites[0], v.position) - vertex_tolerance;
  }

  /// The Voronoi vertex of a face. It is computed from its sites in an order that does not depend on CGAL's.
  Vec2 vertex_of(const Graph& graph, Graph::Finite_faces_iterator face) const {
    std::array<CurveSite, 3> sites;
    for (int i = 0; i < 3; ++i) sites[static_cast<std::size_t>(i)] = site_of(face->vertex(i)->site());
    const auto first = static_cast<int>(std::min_element(sites.begin(), sites.end()) - sites.begin());
    const auto at = [&](int i) { return face->vertex((first + i) % 3)->site(); };
    const auto p = graph.geom_traits().construct_svd_vertex_2_object()(at(0), at(1), at(2));
    const auto site = [&](int i) { return sites[static_cast<std::size_t>((first + i) % 3)]; };
    return improved({p.x(), p.y()}, site(0), site(1), site(2));
  }

  /// The polished vertex. If that is not good enough, polishing starts again from the circle through the
  /// sites' nearest points: two points and a parallel segment make CGAL's formula divide by almost zero, and
  /// neighbours that hardly turn may send Newton's method to the wrong root.
  Vec2 improved(const Vec2& rounded, const CurveSite& a, const CurveSite& b, const CurveSite& c) const {
    const std::array sites{a, b, c};
    const Vertex usual = polished(rounded, a, b, c);
    const double moved = (usual.position - rounded).norm();
    const bool near = moved <= most_polishing_move * distance(a, rounded);
    if (near ? meets(usual, sites) : is_vertex(usual, sites)) return usual.position;
    const Vec2 centre = (middle(a) + middle(b) + middle(c)) / 3;
    Vec2 p = centre;
    for (int round = 0; round < most_restarts; ++round) {
      p = start_near(p, a, b, c);
      if (!p.allFinite()) break;
      const Vertex again = polished(p, a, b, c);
      if (is_vertex(again, sites)) return again.position;
    }
    return rounded.allFinite() ? rounded : centre;
  }

  /// A common end of two sites, and the direction of the curve there.
  struct Joint {
    Vec2 end, direction;
  };

  std::optional<Joint> joint(const CurveSite& l, const CurveSite& r) const {
    if (l.segment && r.segment) {
      const bool forth = sites_.after(l.index) == r.index, back = sites_.after(r.index) == l.index;
      if (!forth && !back) return std::nullopt;
      return Joint{sites_.curve()[forth ? r.index : l.index],
                   sites_.direction(l.index) + sites_.direction(r.index)};
    }
    const CurveSite &segment = l.segment ? l : r, &end = l.segment ? r : l;
    if (!segment.segment || !sites_.ends_in(segment.index, end.index)) return std::nullopt;
    return Joint{sites_.curve()[end.index], sites_.direction(segment.index)};
  }

  /// A guess at the vertex: the centre of a circle that touches the sites where they are nearest to `p`.
  Vec2 start_near(const Vec2& p, const CurveSite& a, const CurveSite& b, const CurveSite& c) const {
    for (const auto& [l, r, third] : {std::array{a, b, c}, std::array{b, c, a}, std::array{c, a, b}}) {
      const std::optional<Joint> end = joint(l, r);
      if (!end) continue;
      // The circle touches both there.
      const Vec2 m = perpendicular(end->direction).normalized();
      const Vec2 off = end->end - nearest_point(third, p);
      return end->end - off.squaredNorm() / (2 * m.dot(off)) * m;
    }
    const Vec2 q = nearest_point(a, p), u = nearest_point(b, p) - q, v = nearest_point(c, p) - q;
    const double u2 = u.squaredNorm(), v2 = v.squaredNorm();
    return q + Vec2(v.y() * u2 - u.y() * v2, u.x() * v2 - v.x() * u2) / (2 * cross(u, v));
  }

  Vec2 middle(const CurveSite& site) const {
    return site.segment ? Vec2((sites_.segment(site.index).a + sites_.segment(site.index).b) / 2)
                        : point(site.index);
  }

  const CurveSites& sites_;
  const std::vector<std::size_t>& near_;  ///< segments, ascending
  std::vector<std::size_t> vertices_;     ///< ascending
  std::unordered_multimap<std::uint64_t, std::size_t> vertex_at_;
  std::vector<Vec2> far_;  ///< the points that close the diagram
};

}  // namespace

std::vector<std::size_t> vertices_of(const CurveSites& sites, const std::vector<std::size_t>& segments) {
  std::vector<std::size_t> vertices;
  for (const std::size_t i : segments) {
    vertices.push_back(i);
    vertices.push_back(sites.after(i));
  }
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

std::vector<CellBorder> piece_diagram(const CurveSites& sites, const std::vector<std::size_t>& segments) {
  return PieceDiagram(sites, segments).run();
}

}  // namespace unicursal::core
