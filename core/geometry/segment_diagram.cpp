#include "core/geometry/segment_diagram.hpp"

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

#include "core/geometry/border_index.hpp"
#include "core/geometry/clip.hpp"
#include "core/geometry/diagram_arc.hpp"
#include "core/geometry/diagram_frame.hpp"
#include "core/geometry/segment_grid.hpp"

namespace unicursal::core {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Traits = CGAL::Segment_Delaunay_graph_filtered_traits_without_intersections_2<Kernel>;
using Graph = CGAL::Segment_Delaunay_graph_2<Traits>;

constexpr int most_polishing_steps = 8;
constexpr int most_restarts = 6;
constexpr double most_polishing_move =
    1e-3;  ///< of a vertex's distance from its sites; beyond it, look twice
constexpr double vertex_tolerance =
    1e-8;  ///< mm, by which the distances of a vertex's three sites may differ
constexpr double least_turn =
    1e-12;  ///< sine between two borders below which their meeting point is left as it is
constexpr double least_mean =
    0.99;  ///< squared, of two directions' sum, for neighbours that do not turn back
constexpr double off_lines =
    1e-11;  ///< mm, by which the diagram is taken to lie beside the border: beyond rounding, no area
constexpr double far_away = 20;       ///< diagonals of a piece to the sites that close its diagram
constexpr double piece_size = 1500;   ///< segments in a piece of the island
constexpr double small_curve = 2.0;   ///< pieces; below it the island is not divided
constexpr double off_round = 0.0137;  ///< of a piece, where the first line runs: off any round number
constexpr double first_halo = 0.9;    ///< mean spacings around a piece where segments are looked for first
constexpr double headroom = 1.1;      ///< of a look that has to reach farther
constexpr std::size_t pieces_in_memory = 64;

/// A vertex of the curve, or the open segment that leaves it. Points far away that close the diagram count on
/// from the last vertex.
struct Site {
  std::size_t index = 0;
  bool segment = false;
  friend auto operator<=>(const Site&, const Site&) = default;
};

/// The border between two cells; the left site's cell lies to its left.
struct Boundary {
  Site left, right;
  Vec2 from{0, 0}, to{0, 0};
  friend bool operator<(const Boundary& a, const Boundary& b) {
    return std::make_tuple(a.left, a.right, a.from.x(), a.from.y(), a.to.x()) <
           std::make_tuple(b.left, b.right, b.from.x(), b.from.y(), b.to.x());
  }
};

Boundary ordered(const Boundary& b) {
  return b.left < b.right ? b : Boundary{b.right, b.left, b.to, b.from};
}

/// Gauss–Legendre on [0, 1], four points: exact for polynomials of degree 7.
constexpr std::array<double, 4> gauss_point{0.06943184420297371, 0.33000947820757187, 0.66999052179242813,
                                            0.93056815579702629};
constexpr std::array<double, 4> gauss_weight{0.17392742256872693, 0.32607257743127307, 0.32607257743127307,
                                             0.17392742256872693};

std::uint64_t key_of(double x, double y) {
  std::uint64_t a = 0, b = 0;
  x += 0.0, y += 0.0;  // −0 becomes 0
  std::memcpy(&a, &x, sizeof a);
  std::memcpy(&b, &y, sizeof b);
  return (a * 0x9E3779B97F4A7C15ULL) ^ (b + 0x7F4A7C15F39CC060ULL + (a << 6));
}

/// The whole curve, for all pieces of its diagram.
struct CurveIndex {
  explicit CurveIndex(const Ring& ring)
      : curve(ring),
        pitch(1.5 * perimeter(ring) / static_cast<double>(ring.size())),
        segments(segments_of(ring)),
        grid(segments, pitch) {}

  static std::vector<Segment> segments_of(const Ring& ring) {
    std::vector<Segment> result(ring.size());
    for (std::size_t i = 0; i < ring.size(); ++i) result[i] = {ring[i], ring[(i + 1) % ring.size()]};
    return result;
  }

  const Ring& curve;
  double pitch;
  std::vector<Segment> segments;
  SegmentGrid grid;
};

/// What the cells inside one piece of the island add up to.
struct PieceCells {
  std::vector<std::size_t>
      vertices;  ///< ascending; those whose cells, or whose segments' cells, may be there
  std::vector<CellIntegrals> points, segments;
  double missing = 0;  ///< mm, by which segments should have been looked for farther away
};

/// The diagram of all segments in a box, inside one piece of the island. It is that of the whole curve if for
/// every point of the piece the circle that reaches to the nearest of them stays in the box.
class Judge {
 public:
  Judge(const CurveIndex& all, const std::vector<std::size_t>& near, const Frame& frame, const Polygon& piece)
      : curve_(all.curve),
        pitch_(all.pitch),
        segments_(all.segments),
        grid_(all.grid),
        near_(near),
        frame_(frame),
        border_(piece, all.pitch),
        pieces_(border_.edges().size()) {
    for (const std::size_t i : near) {
      result_.vertices.push_back(i);
      result_.vertices.push_back((i + 1) % curve_.size());
    }
    std::sort(result_.vertices.begin(), result_.vertices.end());
    result_.vertices.erase(std::unique(result_.vertices.begin(), result_.vertices.end()),
                           result_.vertices.end());
    result_.points.resize(result_.vertices.size());
    result_.segments.resize(result_.vertices.size());
  }

  PieceCells run() {
    // CGAL shuffles what it inserts; the order must not depend on what was done before.
    CGAL::get_default_random() = CGAL::Random(0);
    Graph graph;
    insert(graph);
    std::unordered_map<const void*, Vec2> centre;
    for (auto face = graph.finite_faces_begin(); face != graph.finite_faces_end(); ++face) {
      centre.emplace(&*face, vertex_of(graph, face));
    }
    std::vector<Boundary> boundaries;
    for (auto edge = graph.finite_edges_begin(); edge != graph.finite_edges_end(); ++edge) {
      const auto face = edge->first;
      const auto other = face->neighbor(edge->second);
      if (graph.is_infinite(face) || graph.is_infinite(other)) continue;
      const Site left = site_of(face->vertex(Graph::ccw(edge->second))->site());
      const Site right = site_of(face->vertex(Graph::cw(edge->second))->site());
      // A far site's borders lie outside the island.
      if (left.index < curve_.size() && right.index < curve_.size())
        boundaries.push_back(ordered({left, right, centre.at(&*other), centre.at(&*face)}));
    }
    // CGAL's order depends on addresses; sums must not.
    std::sort(boundaries.begin(), boundaries.end());
    for (const Boundary& boundary : boundaries) add_arc(boundary);
    add_border();
    return std::move(result_);
  }

 private:
  void insert(Graph& graph) {
    std::vector<Kernel::Point_2> points;
    std::vector<std::pair<std::size_t, std::size_t>> ends;
    Box box{curve_[near_[0]], curve_[near_[0]]};
    for (const std::size_t i : result_.vertices) {
      points.emplace_back(curve_[i].x(), curve_[i].y());
      vertex_at_.emplace(key_of(curve_[i].x(), curve_[i].y()), i);
      box.min = box.min.cwiseMin(curve_[i]);
      box.max = box.max.cwiseMax(curve_[i]);
    }
    for (const std::size_t i : near_) ends.emplace_back(place(i), place((i + 1) % curve_.size()));
    graph.insert_segments(points.begin(), points.end(), ends.begin(), ends.end());
    const double far = far_away * (box.size().norm() + 1);
    for (const Vec2& way : {Vec2(1, 0.1), Vec2(-0.1, 1), Vec2(-1, -0.1), Vec2(0.1, -1)}) {
      const Vec2 p = box.center() + far * way;
      vertex_at_.emplace(key_of(p.x(), p.y()), curve_.size() + far_.size());
      far_.push_back(p);
      graph.insert(Graph::Site_2::construct_site_2({p.x(), p.y()}));
    }
  }

  const Vec2& point(std::size_t index) const {
    return index < curve_.size() ? curve_[index] : far_[index - curve_.size()];
  }

  std::size_t vertex_of(const Kernel::Point_2& p) const {
    const auto [first, last] = vertex_at_.equal_range(key_of(p.x(), p.y()));
    const auto found =
        std::find_if(first, last, [&](const auto& v) { return point(v.second) == Vec2(p.x(), p.y()); });
    assert(found != last);
    return found->second;
  }

  Site site_of(const Graph::Site_2& site) const {
    if (site.is_point()) return {vertex_of(site.point()), false};
    const std::size_t a = vertex_of(site.source()), b = vertex_of(site.target());
    return {(a + 1) % curve_.size() == b ? a : b, true};
  }

  /// Of a vertex, among those of the piece.
  std::size_t place(std::size_t vertex) const {
    const auto found = std::lower_bound(result_.vertices.begin(), result_.vertices.end(), vertex);
    return static_cast<std::size_t>(found - result_.vertices.begin());
  }

  CellIntegrals& cell(const Site& site) {
    return (site.segment ? result_.segments : result_.points)[place(site.index)];
  }

  /// False where segments had to be looked for farther away.
  bool has(const Site& site) const {
    const std::size_t k = place(site.index);
    return k < result_.vertices.size() && result_.vertices[k] == site.index;
  }

  /// What is missing is a convex function of the place in each cell: greatest where stretches of its border
  /// end.
  void note_ends(const Site& site, const Arc& arc, double s0, double s1) {
    for (const double s : {s0, s1}) {
      const Vec2 p = arc.at(s);
      const double inside =
          std::min((p - frame_.searched.min).minCoeff(), (frame_.searched.max - p).minCoeff());
      result_.missing = std::max(result_.missing, (nearest_point(site, p) - p).norm() - inside);
    }
  }

  /// Adds a stretch that has the site's cell on its left.
  void integrate(const Site& site, const Arc& arc, double s0, double s1, double sign) {
    CellIntegrals sum;
    const Vec2 origin = curve_[site.index];
    const Vec2 u = site.segment ? direction(site.index) : Vec2(0, 0);
    for (std::size_t g = 0; g < gauss_point.size(); ++g) {
      const double s = s0 + (s1 - s0) * gauss_point[g], weight = gauss_weight[g] * (s1 - s0);
      const Vec2 p = arc.at(s) - origin, dp = arc.derivative(s);
      if (site.segment) {
        const double y = cross(u, p), dx = u.dot(dp);
        sum.area -= weight * y * dx;
        sum.second_moment -= weight * y * y * y / 3 * dx;
      } else {
        const double sweep = weight * cross(p, dp);
        sum.area += sweep / 2;
        sum.second_moment += sweep * p.squaredNorm() / 4;
      }
    }
    cell(site).area += sign * sum.area;
    cell(site).second_moment += sign * sum.second_moment;
  }

  bool ends_in(std::size_t segment, std::size_t vertex) const {
    return segment == vertex || (segment + 1) % curve_.size() == vertex;
  }

  /// Where two sites are equally far: a residual, mm, and its gradient.
  struct Residual {
    double value;
    Vec2 gradient;
  };

  Residual distance_of(const Site& site, const Vec2& p) const {
    const Vec2 off = p - point(site.index);
    if (!site.segment) {
      const double d = off.norm();
      return {d, d > 0 ? Vec2(off / d) : Vec2(0, 0)};
    }
    const Vec2 n = perpendicular(direction(site.index));
    const double h = off.dot(n);
    return h >= 0 ? Residual{h, n} : Residual{-h, -n};
  }

  Vec2 direction(std::size_t segment) const {
    return (segments_[segment].b - segments_[segment].a).normalized();
  }

  Residual difference(const Site& l, const Site& r, const Vec2& p) const {
    // Their border is the line at right angles to the curve there, however little neighbours turn.
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
    double error = 0;  ///< mm, by how much the three distances differ
  };

  /// CGAL's vertices are rounded, badly so where three sites nearly line up. Newton's method restores what
  /// double precision can give, with the two of the three conditions that differ most: neighbours that hardly
  /// turn are as good as one site for any third.
  Vertex polished(Vec2 p, const Site& a, const Site& b, const Site& c) const {
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

  Vec2 nearest_point(const Site& site, const Vec2& p) const {
    if (!site.segment) return point(site.index);
    const Segment& s = segments_[site.index];
    return s.a + std::clamp((p - s.a).dot(s.b - s.a) / (s.b - s.a).squaredNorm(), 0.0, 1.0) * (s.b - s.a);
  }

  /// Nothing else is nearer than the three sites.
  bool is_vertex(const Vertex& v, const Site& site) const {
    if (!(v.error < vertex_tolerance) || !v.position.allFinite()) return false;
    const double own = (nearest_point(site, v.position) - v.position).norm();
    const Site other = nearest(v.position);
    return (nearest_point(other, v.position) - v.position).norm() > own - vertex_tolerance;
  }

  /// The Voronoi vertex of a face, computed from its sites in one order whatever CGAL's is.
  Vec2 vertex_of(const Graph& graph, Graph::Finite_faces_iterator face) const {
    std::array<Site, 3> sites;
    for (int i = 0; i < 3; ++i) sites[static_cast<std::size_t>(i)] = site_of(face->vertex(i)->site());
    const auto first = static_cast<int>(std::min_element(sites.begin(), sites.end()) - sites.begin());
    const auto at = [&](int i) { return face->vertex((first + i) % 3)->site(); };
    const auto p = graph.geom_traits().construct_svd_vertex_2_object()(at(0), at(1), at(2));
    const auto site = [&](int i) { return sites[static_cast<std::size_t>((first + i) % 3)]; };
    return improved({p.x(), p.y()}, site(0), site(1), site(2));
  }

  /// Two points and a parallel segment make CGAL's formula divide by almost nothing, and neighbours that
  /// hardly turn may send Newton's method to the wrong root. Then start again from the circle through the
  /// sites' nearest points.
  Vec2 improved(const Vec2& rounded, const Site& a, const Site& b, const Site& c) const {
    const Vertex usual = polished(rounded, a, b, c);
    const double moved = (usual.position - rounded).norm();
    const double near = most_polishing_move * (nearest_point(a, rounded) - rounded).norm();
    if (usual.error < vertex_tolerance && (moved <= near || is_vertex(usual, a))) return usual.position;
    const Vec2 centre = (middle(a) + middle(b) + middle(c)) / 3;
    Vec2 p = centre;
    for (int round = 0; round < most_restarts; ++round) {
      p = start_near(p, a, b, c);
      if (!p.allFinite()) break;
      const Vertex again = polished(p, a, b, c);
      if (is_vertex(again, a)) return again.position;
    }
    return rounded.allFinite() ? rounded : centre;
  }

  /// A common end of two sites, and the direction of the curve there.
  struct Joint {
    Vec2 end, direction;
  };

  std::optional<Joint> joint(const Site& l, const Site& r) const {
    if (l.segment && r.segment) {
      const bool forth = (l.index + 1) % curve_.size() == r.index,
                 back = (r.index + 1) % curve_.size() == l.index;
      if (!forth && !back) return std::nullopt;
      return Joint{curve_[forth ? r.index : l.index], direction(l.index) + direction(r.index)};
    }
    const Site &segment = l.segment ? l : r, &end = l.segment ? r : l;
    if (!segment.segment || !ends_in(segment.index, end.index)) return std::nullopt;
    return Joint{curve_[end.index], direction(segment.index)};
  }

  /// A guess at the vertex: the centre of a circle that touches the sites where they are nearest to `p`.
  Vec2 start_near(const Vec2& p, const Site& a, const Site& b, const Site& c) const {
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

  Vec2 middle(const Site& site) const {
    return site.segment ? Vec2((segments_[site.index].a + segments_[site.index].b) / 2) : point(site.index);
  }

  Arc arc_between(const Site& l, const Site& r, const Vec2& from, const Vec2& to) const {
    if (l.segment == r.segment) return line(from, to);
    const Site& point = l.segment ? r : l;
    const Site& segment = l.segment ? l : r;
    if (ends_in(segment.index, point.index)) return line(from, to);
    const Segment& s = segments_[segment.index];
    return parabola(from, to, curve_[point.index], s.a, direction(segment.index));
  }

  /// Both cells' share of the border between them, clipped by the island.
  void add_arc(const Boundary& boundary) {
    const auto& [left, right, from, to] = boundary;
    if (from == to) return;
    const Arc arc = arc_between(left, right, from, to);
    std::vector<double> cuts{0, 1};
    std::vector<std::size_t> near;
    border_.near(bounds(arc), [&](std::size_t e) { near.push_back(e); });
    std::sort(near.begin(), near.end());
    near.erase(std::unique(near.begin(), near.end()), near.end());
    for (const std::size_t e : near) {
      const BorderEdge& edge = border_.edges()[e];
      for (const double s : crossings(arc, edge.a, edge.b)) {
        cuts.push_back(s);
        cut_border(e, arc.at(s));
      }
      // Whether it reaches the border is a matter of rounding, and not the same for edges that coincide.
      for (const Vec2& end : {arc.from, arc.to}) {
        if (distance_to_segment(end, edge.a, edge.b) < rounding_slack) cut_border(e, end);
      }
    }
    std::sort(cuts.begin(), cuts.end());
    for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
      const int winding = border_.winding(arc.at((cuts[k] + cuts[k + 1]) / 2) + aside());
      if (winding == 0) continue;
      note_ends(left, arc, cuts[k], cuts[k + 1]);
      integrate(left, arc, cuts[k], cuts[k + 1], winding);
      integrate(right, arc, cuts[k], cuts[k + 1], -winding);
    }
  }

  /// Where cells' borders run along the island's border, both must go to the same side of each other: as if
  /// the whole diagram lay a little aside.
  static Vec2 aside() { return off_lines * Vec2(0.8090169943749475, 0.5877852522924731); }

  /// Notes that a cell's border comes to edge `e` at `p`; once too often does no harm.
  void cut_border(std::size_t e, const Vec2& p) {
    const BorderEdge& edge = border_.edges()[e];
    const Vec2 along = edge.b - edge.a;
    pieces_[e].push_back(std::clamp((p - edge.a).dot(along) / along.squaredNorm(), 0.0, 1.0));
  }

  Site nearest(const Vec2& p) const {
    double best = std::numeric_limits<double>::infinity();
    std::size_t index = 0;
    for (double reach = pitch_, searched = 0; !(best <= searched); searched = reach, reach *= 2) {
      const Vec2 margin(reach, reach);
      grid_.near({p - margin, p + margin}, [&](std::size_t i) {
        const double d = distance_to_segment(p, segments_[i].a, segments_[i].b);
        if (d < best) best = d, index = i;
      });
    }
    const Segment& s = segments_[index];
    const double t = (p - s.a).dot(s.b - s.a) / (s.b - s.a).squaredNorm();
    if (t <= 0) return {index, false};
    if (t >= 1) return {(index + 1) % curve_.size(), false};
    return {index, true};
  }

  void add_border() {
    for (std::size_t e = 0; e < pieces_.size(); ++e) {
      const BorderEdge& edge = border_.edges()[e];
      if (edge.a == edge.b) continue;
      const bool cut_off = frame_.on_line(edge.a, edge.b);
      std::vector<double>& cuts = pieces_[e];
      if (cut_off) add_corners(edge, cuts);
      cuts.push_back(0);
      cuts.push_back(1);
      std::sort(cuts.begin(), cuts.end());
      const Arc arc = line(edge.a, edge.b);
      for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
        if (cuts[k + 1] <= cuts[k]) continue;
        const Vec2 middle = arc.at((cuts[k] + cuts[k + 1]) / 2);
        // Along the lines between pieces, edges outside the island run back and forth.
        if (cut_off && frame_.island->winding(middle) == 0) continue;
        const Site site = nearest(middle - aside());
        note_ends(site, arc, cuts[k], cuts[k + 1]);
        if (has(site)) integrate(site, arc, cuts[k], cuts[k + 1], 1);
      }
    }
  }

  /// Where other edges meet one that runs along a line between pieces.
  void add_corners(const BorderEdge& edge, std::vector<double>& cuts) const {
    for (const BorderEdge& other : border_.edges()) {
      if (!frame_.on_line(edge.a, edge.b, other.a)) continue;
      const double s = (other.a - edge.a).dot(edge.b - edge.a) / (edge.b - edge.a).squaredNorm();
      if (s > 0 && s < 1) cuts.push_back(s);
    }
  }

  const Ring& curve_;
  double pitch_;
  const std::vector<Segment>& segments_;
  const SegmentGrid& grid_;
  const std::vector<std::size_t>& near_;  ///< segments, ascending
  Frame frame_;
  BorderIndex border_;
  std::vector<std::vector<double>> pieces_;  ///< per border edge, where cells' borders meet it
  std::unordered_multimap<std::uint64_t, std::size_t> vertex_at_;
  std::vector<Vec2> far_;  ///< the points that close the diagram
  PieceCells result_;
};

/// The island, divided along lines into rectangles of about `piece_size` segments.
class Pieces {
 public:
  Pieces(const CurveIndex& all, const Polygon& island)
      : all_(all), island_(island), border_(island, all.pitch), box_(bounds(island)) {
    const auto count = static_cast<double>(all.curve.size());
    spacing_ = area(island) / perimeter(all.curve);
    if (count <= small_curve * piece_size) return;
    const double side = std::sqrt(area(island) * piece_size / count);
    columns_ = static_cast<std::size_t>(std::ceil(box_.size().x() / side));
    rows_ = static_cast<std::size_t>(std::ceil(box_.size().y() / side));
  }

  std::size_t count() const { return columns_ * rows_; }

  /// Cells inside piece `number`; none when nothing of the island lies there.
  PieceCells cells(std::size_t number) const {
    Frame frame{&border_, lines(number), {}};
    const Polygon piece = polygon(frame.lines);
    if (piece.outer.size() < 3) return {};
    const double everywhere = std::numeric_limits<double>::infinity();
    const Box box = bounds(piece);
    for (double halo = count() > 1 ? first_halo * spacing_ : everywhere;;) {
      frame.searched = {box.min.array() - halo, box.max.array() + halo};
      const std::vector<std::size_t> found = near(frame.searched);
      PieceCells cells;
      if (!found.empty()) cells = Judge(all_, found, frame, piece).run();
      if (!found.empty() && cells.missing <= 0) return cells;
      halo = found.empty() ? 2 * halo : headroom * (halo + cells.missing);
    }
  }

 private:
  static double line(double low, double size, std::size_t number, std::size_t count) {
    if (number == 0) return -std::numeric_limits<double>::infinity();
    if (number == count) return std::numeric_limits<double>::infinity();
    return low + size * (static_cast<double>(number) + off_round) / static_cast<double>(count);
  }

  Box lines(std::size_t number) const {
    const std::size_t column = number % columns_, row = number / columns_;
    const Vec2 low = box_.min, size = box_.size();
    return {{line(low.x(), size.x(), column, columns_), line(low.y(), size.y(), row, rows_)},
            {line(low.x(), size.x(), column + 1, columns_), line(low.y(), size.y(), row + 1, rows_)}};
  }

  Polygon polygon(const Box& between) const {
    Polygon piece = island_;
    const auto clip = [&](Side side, double at) {
      if (!std::isfinite(at)) return;
      piece.outer = clipped(piece.outer, side, at);
      piece.holes = clipped(piece.holes, side, at);
    };
    clip(Side::right, between.min.x());
    clip(Side::left, between.max.x());
    clip(Side::above, between.min.y());
    clip(Side::below, between.max.y());
    return piece;
  }

  /// Segments whose boxes meet a box, ascending.
  std::vector<std::size_t> near(const Box& box) const {
    std::vector<std::size_t> found;
    all_.grid.near(box, [&](std::size_t i) {
      const Segment& s = all_.segments[i];
      if ((s.a.cwiseMin(s.b).array() <= box.max.array()).all() &&
          (s.a.cwiseMax(s.b).array() >= box.min.array()).all())
        found.push_back(i);
    });
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
  }

  const CurveIndex& all_;
  const Polygon& island_;
  BorderIndex border_;
  Box box_;
  double spacing_ = 0;  ///< mm, mean, of the curve
  std::size_t columns_ = 1, rows_ = 1;
};

void add(CellIntegrals& sum, const CellIntegrals& more) {
  sum.area += more.area;
  sum.second_moment += more.second_moment;
}

}  // namespace

SegmentDiagram segment_diagram(const Ring& curve, const Polygon& island, Workers* workers) {
  const CurveIndex all(curve);
  const Pieces pieces(all, island);
  Workers serial(1);
  SegmentDiagram diagram{std::vector<CellIntegrals>(curve.size()), std::vector<CellIntegrals>(curve.size())};
  std::vector<PieceCells> cells;
  for (std::size_t first = 0; first < pieces.count(); first += pieces_in_memory) {
    cells.assign(std::min(pieces_in_memory, pieces.count() - first), {});
    (workers != nullptr ? *workers : serial).each(cells.size(), [&](std::size_t k) {
      cells[k] = pieces.cells(first + k);
    });
    for (const PieceCells& piece : cells) {
      for (std::size_t k = 0; k < piece.vertices.size(); ++k) {
        add(diagram.points[piece.vertices[k]], piece.points[k]);
        add(diagram.segments[piece.vertices[k]], piece.segments[k]);
      }
    }
  }
  return diagram;
}

}  // namespace unicursal::core
