#include "core/graph/cell_graph.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/geometry/border_index.hpp"
#include "core/geometry/predicates.hpp"
#include "core/graph/needle_diagram.hpp"
#include "core/graph/needles.hpp"
#include "core/stopping.hpp"

namespace unicursal::core {
namespace {

constexpr int tries = 6;
constexpr int needle_tries = 3;          ///< tries with needles, before those with points
constexpr int needle_iterations = 30;    ///< with 100, only 5 % more edges follow the field
constexpr double shaking = 1e-3;         ///< how far seeds move before the next try, as a share of d
constexpr double area_tolerance = 1e-6;  ///< relative difference of the cells' area and the domain's

/// Where a Voronoi edge passes through the border.
struct Crossing {
  std::size_t border_edge = 0;
  double along_voronoi = 0;  ///< 0…1
  double along_border = 0;   ///< 0…1
  bool leaving = false;
  NodeIndex node;
};

class Clipper {
 public:
  Clipper(const Voronoi& diagram, const Polygon& domain)
      : diagram_(diagram), domain_(domain), border_(domain, typical_edge()) {}

  std::optional<CellGraph> run(std::vector<std::size_t>& untouched_holes) {
    place_inner_nodes();
    for (const VoronoiEdgeIndex e : diagram_.edges.indices()) {
      if (!cut(e)) return std::nullopt;
    }
    if (!connect_inner_nodes() || !walk_borders(untouched_holes)) return std::nullopt;
    link_half_edges();
    if (!trace_faces()) return std::nullopt;
    return std::move(graph_);
  }

 private:
  double typical_edge() const {
    const double diameter = bounds(domain_).size().norm();
    return diameter / std::clamp(std::sqrt(static_cast<double>(diagram_.edges.size())), 4.0, 3000.0);
  }

  void place_inner_nodes() {
    node_of_.resize(diagram_.vertices.size());
    for (const VoronoiVertexIndex v : diagram_.vertices.indices()) {
      if (border_.contains(diagram_.vertices[v].position))
        node_of_[v] = add_node(diagram_.vertices[v].position);
    }
    half_of_.resize(diagram_.edges.size());
  }

  NodeIndex add_node(const Vec2& position) {
    spokes_.push_back({});
    return graph_.position.push_back(position);
  }

  /// Where the line from p to q crosses the border, in order. Signs are exact, and zero counts as positive,
  /// so that a line through a border vertex passes on one side of it.
  std::vector<Crossing> crossings(const Vec2& p, const Vec2& q) const {
    std::vector<std::size_t> near;
    border_.near({p.cwiseMin(q), p.cwiseMax(q)}, [&](std::size_t e) { near.push_back(e); });
    std::sort(near.begin(), near.end());
    near.erase(std::unique(near.begin(), near.end()), near.end());
    std::vector<Crossing> found;
    for (const std::size_t e : near) {
      const Vec2 &a = border_.edges()[e].a, &b = border_.edges()[e].b;
      const bool p_left = orientation(a, b, p) >= 0, q_left = orientation(a, b, q) >= 0;
      if (p_left == q_left) continue;
      if ((orientation(p, q, a) >= 0) == (orientation(p, q, b) >= 0)) continue;
      const double slope = cross(q - p, b - a);
      found.push_back(
          {e, cross(a - p, b - a) / slope, std::clamp(cross(a - p, q - p) / slope, 0.0, 1.0), p_left, {}});
    }
    std::sort(found.begin(), found.end(),
              [](const Crossing& l, const Crossing& r) { return l.along_voronoi < r.along_voronoi; });
    return found;
  }

  /// A stretch of a Voronoi edge inside the domain, which ends where the edge ends or leaves the domain.
  struct Stretch {
    VoronoiEdgeIndex voronoi_edge;
    NodeIndex begin;       ///< invalid outside
    bool at_start = true;  ///< it begins where the Voronoi edge does
    Ring bends;
  };

  HalfEdgeIndex add_stretch(Stretch& stretch, NodeIndex end) {
    const HalfEdgeIndex h = graph_.add_edge(stretch.begin, end, std::move(stretch.bends));
    if (stretch.at_start)
      half_of_[stretch.voronoi_edge][0] = h;
    else
      spokes_[stretch.begin][1] = h;
    return h;
  }

  /// Follows a Voronoi edge over the border: ends the stretch inside, or begins one. Returns false if the
  /// crossing contradicts the earlier ones.
  bool cross_border(Crossing& crossing, Stretch& stretch) {
    const bool inside = stretch.begin.valid();
    if (crossing.leaving != inside) return false;
    const BorderEdge& border = border_.edges()[crossing.border_edge];
    crossing.node = add_node(border.a + crossing.along_border * (border.b - border.a));
    crossings_.push_back(crossing);
    if (inside) {
      const HalfEdgeIndex h = add_stretch(stretch, crossing.node);
      spokes_[crossing.node][1] = PlanarGraph::twin(h);
    }
    stretch = {stretch.voronoi_edge, inside ? NodeIndex() : crossing.node, false, {}};
    return true;
  }

  /// Keeps the stretches of a Voronoi edge that lie inside. Returns false if ends and crossings contradict
  /// each other.
  bool cut(VoronoiEdgeIndex number) {
    const VoronoiEdge& edge = diagram_.edges[number];
    const NodeIndex end = node_of_[edge.to];
    Stretch stretch{number, node_of_[edge.from], true, {}};
    Vec2 here = diagram_.vertices[edge.from].position;
    for (std::size_t piece = 0; piece <= edge.via.size(); ++piece) {
      const bool last = piece == edge.via.size();
      const Vec2& there = last ? diagram_.vertices[edge.to].position : edge.via[piece];
      for (Crossing& crossing : crossings(here, there)) {
        if (!cross_border(crossing, stretch)) return false;
      }
      if (!last && stretch.begin.valid()) stretch.bends.push_back(there);
      here = there;
    }
    if (stretch.begin.valid() != end.valid()) return false;
    if (end.valid()) half_of_[number][1] = PlanarGraph::twin(add_stretch(stretch, end));
    return true;
  }

  bool connect_inner_nodes() {
    for (const VoronoiVertexIndex v : diagram_.vertices.indices()) {
      if (!node_of_[v].valid()) continue;
      for (std::size_t i = 0; i < 3; ++i) {
        const VoronoiEdgeIndex edge = diagram_.vertices[v].edges[i];
        if (!edge.valid()) return false;
        const bool starts = diagram_.edges[edge].from == v;
        const HalfEdgeIndex h = half_of_[edge][starts ? 0 : 1];
        if (!h.valid()) return false;
        spokes_[node_of_[v]][i] = h;
      }
    }
    return true;
  }

  /// Makes an edge of each stretch of border between neighbouring crossings; it bends with the border.
  /// Returns false if no Voronoi edge reaches one of the rings.
  bool walk_borders(std::vector<std::size_t>& untouched_holes) {
    std::sort(crossings_.begin(), crossings_.end(), [](const Crossing& l, const Crossing& r) {
      return l.border_edge != r.border_edge ? l.border_edge < r.border_edge : l.along_border < r.along_border;
    });
    auto begin = crossings_.begin();
    bool all_touched = true;
    for (std::size_t ring = 0; ring < border_.ring_count(); ++ring) {
      const std::size_t last_edge = border_.first_edge(ring) + border_.ring_size(ring);
      const auto end = std::find_if(begin, crossings_.end(),
                                    [&](const Crossing& c) { return c.border_edge >= last_edge; });
      if (begin == end) {
        all_touched = false;
        if (ring > 0) untouched_holes.push_back(ring - 1);
      }
      for (auto here = begin; here != end; ++here) {
        const auto there = here + 1 == end ? begin : here + 1;
        const HalfEdgeIndex h = graph_.add_edge(here->node, there->node, bends(*here, *there, ring));
        // Counter-clockwise about a border node: forward, inward, backward.
        spokes_[here->node][0] = h;
        spokes_[there->node][2] = PlanarGraph::twin(h);
        border_half_edges_.push_back(PlanarGraph::twin(h));
      }
      begin = end;
    }
    return all_touched;
  }

  Ring bends(const Crossing& from, const Crossing& to, std::size_t ring) const {
    Ring line;
    const std::size_t first = border_.first_edge(ring), size = border_.ring_size(ring);
    const bool around = to.border_edge < from.border_edge ||
                        (to.border_edge == from.border_edge && to.along_border <= from.along_border);
    std::size_t steps = to.border_edge - from.border_edge + (around ? size : 0);
    for (std::size_t e = from.border_edge; steps > 0; --steps) {
      line.push_back(border_.edges()[e].b);
      e = e + 1 == first + size ? first : e + 1;
    }
    return line;
  }

  /// Arriving at a node, the next half-edge of the face to the left is the one clockwise of the way back.
  void link_half_edges() {
    for (const auto& around : spokes_) {
      for (std::size_t i = 0; i < 3; ++i) {
        const HalfEdgeIndex arriving = PlanarGraph::twin(around[i]);
        graph_.half_edges[arriving].next = around[(i + 2) % 3];
      }
    }
  }

  bool trace_faces() {
    Per<HalfEdgeIndex, bool> seen(graph_.half_edges.size(), false);
    for (const HalfEdgeIndex start : border_half_edges_) {
      for (HalfEdgeIndex h = start; !seen[h]; h = graph_.next(h)) seen[h] = true;
    }
    double covered = 0;
    for (const HalfEdgeIndex start : graph_.half_edges.indices()) {
      if (seen[start]) continue;
      const FaceIndex face = graph_.face_start.push_back(start);
      for (HalfEdgeIndex h = start; !seen[h]; h = graph_.next(h)) {
        seen[h] = true;
        graph_.half_edges[h].face = face;
      }
      const double piece = signed_area(graph_.outline(face));
      if (!(piece > 0)) return false;
      covered += piece;
    }
    return std::abs(covered - area(domain_)) <= area_tolerance * area(domain_);
  }

  const Voronoi& diagram_;
  const Polygon& domain_;
  BorderIndex border_;
  CellGraph graph_;
  Per<VoronoiVertexIndex, NodeIndex> node_of_;                   ///< invalid for a vertex outside
  Per<VoronoiEdgeIndex, std::array<HalfEdgeIndex, 2>> half_of_;  ///< the half-edges that leave its two ends
  Per<NodeIndex, std::array<HalfEdgeIndex, 3>> spokes_;  ///< half-edges that leave it, counter-clockwise
  std::vector<Crossing> crossings_;
  std::vector<HalfEdgeIndex> border_half_edges_;  ///< half-edges with the outside to their left
};

/// Adds a seed on the other side of the hole than the nearest seed, so that the border between the two cells
/// meets the hole.
void add_seed_beyond(const Ring& hole, const Polygon& domain, std::vector<Vec2>& seeds) {
  const Vec2 center = bounds(hole).center();
  const auto nearest = std::min_element(seeds.begin(), seeds.end(), [&](const Vec2& l, const Vec2& r) {
    return (l - center).squaredNorm() < (r - center).squaredNorm();
  });
  const Vec2 away = center - *nearest;
  for (const double turn : {0.0, 0.5, -0.5, 1.0, -1.0, 1.5, -1.5}) {
    for (const double stretch : {1.0, 1.5, 0.7, 2.0}) {
      const double c = std::cos(turn) * stretch, s = std::sin(turn) * stretch;
      const Vec2 candidate = center + Vec2(c * away.x() - s * away.y(), s * away.x() + c * away.y());
      if (contains(domain, candidate)) {
        seeds.push_back(candidate);
        return;
      }
    }
  }
}

/// Moves every seed a little, away from degenerate positions.
void shake(std::vector<Vec2>& seeds, const Polygon& domain, double d, Random& random) {
  for (Vec2& seed : seeds) {
    const double turn = random.uniform(0, 2 * std::numbers::pi);
    const Vec2 moved = seed + shaking * d * random.uniform() * Vec2(std::cos(turn), std::sin(turn));
    if (contains(domain, moved)) seed = moved;
  }
}

}  // namespace

std::optional<CellGraph> clip_to_domain(const Voronoi& diagram, const Polygon& domain,
                                        std::vector<std::size_t>& untouched_holes) {
  untouched_holes.clear();
  return Clipper(diagram, domain).run(untouched_holes);
}

std::optional<CellGraph> clip_to_domain(const std::vector<Vec2>& seeds, const Polygon& domain,
                                        std::vector<std::size_t>& untouched_holes) {
  return clip_to_domain(voronoi(seeds, bounds(domain)), domain, untouched_holes);
}

std::optional<CellGraph> make_cell_graph(const Polygon& domain, const GraphOptions& options, Random& random) {
  const double d = options.seeds.d;
  std::vector<Vec2> seeds = place_seeds(domain, options.seeds, random);
  std::optional<NeedleTessellation> tessellation;
  if (options.field != nullptr && !options.field->empty()) {
    tessellation.emplace(domain, *options.field, d, options.needle_length);
    tessellation->relax(seeds, needle_iterations);
  }
  for (int attempt = 0; attempt < tries; ++attempt) {
    stop_point();
    std::vector<std::size_t> untouched;
    std::vector<Segment> needles;
    std::optional<Voronoi> diagram;
    if (tessellation && attempt < needle_tries) {
      needles = tessellation->needles(seeds);
      diagram = needle_diagram(needles, bounds(domain));
    }
    if (!diagram) {
      needles = as_points(seeds);
      diagram = voronoi(seeds, bounds(domain));
    }
    if (std::optional<CellGraph> graph = clip_to_domain(*diagram, domain, untouched)) {
      graph->needles = std::move(needles);
      return graph;
    }
    if (untouched.empty() && attempt + 2 == tries) seeds = place_seeds(domain, options.seeds, random);
    for (const std::size_t hole : untouched) add_seed_beyond(domain.holes[hole], domain, seeds);
    shake(seeds, domain, d, random);
  }
  return std::nullopt;
}

}  // namespace unicursal::core
