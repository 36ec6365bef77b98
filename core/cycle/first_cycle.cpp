#include "core/cycle/first_cycle.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <deque>
#include <utility>
#include <vector>

#include "core/graph/matching.hpp"
#include "core/graph/refined_graph.hpp"
#include "core/numeric/disjoint_sets.hpp"

namespace unicursal::core {
namespace {

constexpr double cost_steps = 1e5;    ///< the largest cost as a whole number
constexpr double strand_gap = 0.02;   ///< half the gap between the strands of a doubled edge, in edge lengths
constexpr int free_choice = 1 << 20;  ///< more sides to choose from than any cell has

/// A set of edges, two at every node: first several cycles, in the end one. The public functions are to be
/// called in the order in which they are declared.
class CycleCover {
 public:
  CycleCover(const CellGraph& cells, const RunCost& cost)
      : graph_(refine(cells)),
        used_(graph_.edge_count(), false),
        cost_(graph_.edge_count(), 0.0),
        has_cost_(static_cast<bool>(cost)) {
    cell_of_centre_.resize(graph_.node_count());
    for (const FaceIndex cell : graph_.centre.indices()) {
      if (graph_.centre[cell].valid()) cell_of_centre_[graph_.centre[cell]] = cell;
    }
    if (!has_cost_) return;
    for (const EdgeIndex e : graph_.edges()) {
      const Ring line = graph_.line(PlanarGraph::forward(e));
      for (std::size_t i = 0; i + 1 < line.size(); ++i) cost_[e] += cost(line[i], line[i + 1]);
    }
  }

  /// Uses the edges that a perfect matching leaves out: they cover every node of the cell graph with cycles.
  /// Returns false if there is no perfect matching.
  bool invert_matching() {
    Per<EdgeIndex, EdgeEnds> ends;
    for (const EdgeIndex e : IndexRange<EdgeIndex>(graph_.cell_edges)) {
      const HalfEdgeIndex h = PlanarGraph::forward(e);
      ends.push_back({graph_.origin(h), graph_.target(h)});
    }
    const Per<EdgeIndex, bool> matched =
        has_cost_ ? heaviest_perfect_matching(graph_.cell_nodes, ends, whole_costs())
                  : perfect_matching(graph_.cell_nodes, ends);
    if (matched.empty()) return false;
    for (const EdgeIndex e : matched.indices()) used_[e] = !matched[e];
    return true;
  }

  /// Replaces one used side of each cell by the way over the cell's centre. The paper lets cells steal sides
  /// from one another and freezes them; here the cells with a single side left are served first, which has
  /// the same effect.
  void reach_centres() {
    Per<FaceIndex, int> choices(graph_.centre.size(), 0);
    cell_of_.resize(graph_.half_edges.size());
    for (const HalfEdgeIndex h : IndexRange<HalfEdgeIndex>(2 * graph_.cell_edges)) {
      cell_of_[h] = cell_left_of(h);
      if (cell_of_[h] != outside && used(h)) ++choices[cell_of_[h]];
    }
    std::deque<FaceIndex> urgent;
    for (const FaceIndex cell : graph_.centre.indices()) {
      if (graph_.centre[cell].valid() && choices[cell] == 1) urgent.push_back(cell);
    }
    Per<FaceIndex, bool> served(graph_.centre.size(), false);
    for (const FaceIndex cell : graph_.centre.indices()) {
      serve(urgent, choices, served);
      if (!graph_.centre[cell].valid() || served[cell]) continue;
      urgent.push_back(cell);
      serve(urgent, choices, served);
    }
  }

  /// Joins cycles in the manner of Figure 7, the cheapest joins first, as long as there are any.
  void split_and_reconnect() {
    label();
    for (bool changed = true; changed;) {
      changed = false;
      std::vector<Reconnection> found;
      for (const EdgeIndex e : graph_.edges()) {
        if (const auto r = reconnection_about(e)) found.push_back(*r);
      }
      std::stable_sort(found.begin(), found.end(),
                       [](const Reconnection& l, const Reconnection& r) { return l.cost < r.cost; });
      for (const Reconnection& r : found) {
        // An earlier reconnection may have changed the neighbourhood.
        const auto now = reconnection_about(r.diagonal);
        if (!now) continue;
        apply(*now);
        changed = true;
      }
    }
  }

  /// Joins the remaining cycles by doubled edges. Returns nullopt if some cannot be joined.
  std::optional<Cycle> joined() {
    make_stops();
    for (const EdgeIndex e : graph_.edges()) {
      if (!used_[e] && graph_.via[e].empty()) double_edge(PlanarGraph::forward(e));
    }
    Cycle cycle;
    cycle.nodes = static_cast<std::size_t>(
        std::count_if(stops_.begin(), stops_.end(), [](const Stop& s) { return s.visited(); }));
    cycle.unreached_centres = unreached_ + static_cast<std::size_t>(std::count(
                                               graph_.centre.begin(), graph_.centre.end(), NodeIndex()));
    cycle.split_and_reconnect = reconnected_;
    cycle.doubled_edges = doubled_;
    if (!trace(cycle)) return std::nullopt;
    return cycle;
  }

 private:
  /// A neighbour along the cycle, in either direction.
  struct Link {
    StopIndex stop;
    HalfEdgeIndex half_edge;  ///< from this stop to the neighbour
  };
  /// A visit of the cycle to a node; doubled nodes are visited twice.
  struct Stop {
    Vec2 position{0, 0};
    std::array<Link, 2> links;
    bool visited() const { return links[1].stop.valid(); }
  };

  FaceIndex cell_left_of(HalfEdgeIndex h) const {
    const FaceIndex face = graph_.face(h);
    if (face == outside) return outside;
    // A triangle's third corner is its cell's centre; a cell without a centre kept its own face.
    const NodeIndex third = graph_.target(graph_.next(h));
    return graph_.is_centre(third) ? cell_of_centre_[third] : face;
  }

  /// Gives the urgent cells their centres. Their neighbours may become urgent by that, and are served too.
  void serve(std::deque<FaceIndex>& urgent, Per<FaceIndex, int>& choices, Per<FaceIndex, bool>& served) {
    while (!urgent.empty()) {
      const FaceIndex cell = urgent.front();
      urgent.pop_front();
      if (served[cell]) continue;
      served[cell] = true;
      const HalfEdgeIndex side = pick_side(cell, choices);
      if (!side.valid()) {
        ++unreached_;
        continue;
      }
      const HalfEdgeIndex back = graph_.next(side);
      for (const HalfEdgeIndex h : {back, graph_.next(back)}) used_[PlanarGraph::edge(h)] = true;
      used_[PlanarGraph::edge(side)] = false;
      const FaceIndex neighbour = cell_of_[PlanarGraph::twin(side)];
      if (neighbour == outside) continue;
      if (--choices[neighbour] == 1 && graph_.centre[neighbour].valid()) urgent.push_back(neighbour);
    }
  }

  /// The used side of the cell whose way over the centre costs least. Among equals, a side on the border is
  /// preferred (no other cell needs it, and its bends are removed with it), then the side whose neighbour has
  /// the most sides to choose from.
  HalfEdgeIndex pick_side(FaceIndex cell, const Per<FaceIndex, int>& choices) const {
    HalfEdgeIndex best;
    std::pair<double, int> best_rank;
    const HalfEdgeIndex start = graph_.face_start[cell];
    HalfEdgeIndex side = start;
    do {
      const HalfEdgeIndex back = graph_.next(side);
      if (used(side)) {
        const FaceIndex neighbour = cell_of_[PlanarGraph::twin(side)];
        const int freedom = neighbour == outside ? free_choice : choices[neighbour];
        const std::pair rank(cost(back) + cost(graph_.next(back)) - cost(side), -freedom);
        if (!best.valid() || rank < best_rank) best = side, best_rank = rank;
      }
      side = graph_.next(PlanarGraph::twin(back));  // the next triangle around the centre
    } while (side != start);
    return best;
  }

  /// Finds out which nodes lie in the same cycle.
  void label() {
    sets_ = DisjointSets(graph_.node_count());
    for (const EdgeIndex e : graph_.edges()) {
      const HalfEdgeIndex h = PlanarGraph::forward(e);
      if (used_[e]) join(graph_.origin(h), graph_.target(h));
    }
  }
  bool same_cycle(NodeIndex a, NodeIndex b) { return sets_.same(a.number(), b.number()); }
  void join(NodeIndex a, NodeIndex b) { sets_.join(a.number(), b.number()); }

  bool used(HalfEdgeIndex h) const { return used_[PlanarGraph::edge(h)]; }

  bool triangle(HalfEdgeIndex h) const {
    return graph_.face(h) != outside && graph_.next(graph_.next(graph_.next(h))) == h;
  }

  /// Figure 7: two opposite sides of a quadrilateral belong to two cycles, and its other two sides are free.
  /// The cycles become one if they leave the former and take the latter.
  struct Reconnection {
    EdgeIndex diagonal;
    std::array<HalfEdgeIndex, 2> leave{}, take{};
    double cost = 0;
  };

  std::optional<Reconnection> reconnection_about(EdgeIndex e) {
    const HalfEdgeIndex left = PlanarGraph::forward(e), right = PlanarGraph::backward(e);
    if (used(left) || !triangle(left) || !triangle(right)) return std::nullopt;
    if (same_cycle(graph_.origin(left), graph_.origin(right))) return std::nullopt;
    const HalfEdgeIndex l1 = graph_.next(left), l2 = graph_.next(l1);
    const HalfEdgeIndex r1 = graph_.next(right), r2 = graph_.next(r1);
    if (graph_.target(l1) == graph_.target(r1)) return std::nullopt;
    for (const auto& [a, b, c, d] : {std::array{l1, r1, l2, r2}, std::array{l2, r2, l1, r1}}) {
      if (!used(a) || !used(b) || used(c) || used(d)) continue;
      return Reconnection{e, {a, b}, {c, d}, cost(c) + cost(d) - cost(a) - cost(b)};
    }
    return std::nullopt;
  }

  void apply(const Reconnection& r) {
    for (const HalfEdgeIndex h : r.leave) used_[PlanarGraph::edge(h)] = false;
    for (const HalfEdgeIndex h : r.take) used_[PlanarGraph::edge(h)] = true;
    const HalfEdgeIndex h = PlanarGraph::forward(r.diagonal);
    join(graph_.origin(h), graph_.target(h));
    ++reconnected_;
  }

  double cost(HalfEdgeIndex h) const { return cost_[PlanarGraph::edge(h)]; }

  /// The costs of the cell graph's edges as whole numbers, for which the matching is exact.
  Per<EdgeIndex, int> whole_costs() const {
    const IndexRange<EdgeIndex> cell_edges(graph_.cell_edges);
    double largest = 1e-300;
    for (const EdgeIndex e : cell_edges) largest = std::max(largest, std::abs(cost_[e]));
    Per<EdgeIndex, int> result;
    for (const EdgeIndex e : cell_edges)
      result.push_back(static_cast<int>(std::lround(cost_steps * cost_[e] / largest)));
    return result;
  }

  void make_stops() {
    for (const Vec2& position : graph_.position) stops_.push_back({position, {}});
    for (const HalfEdgeIndex h : graph_.half_edges.indices()) {
      if (!used(h)) continue;
      auto& links = stops_[stop_at(graph_.origin(h))].links;
      links[links[0].stop.valid() ? 1 : 0] = {stop_at(graph_.target(h)), h};
    }
    doubled_node_.assign(graph_.node_count(), false);
  }

  /// The first used half-edge clockwise of `h` about its origin.
  HalfEdgeIndex clockwise_used(HalfEdgeIndex h) const {
    do {
      h = graph_.next(PlanarGraph::twin(h));
    } while (!used(h));
    return h;
  }

  /// Figure 8: the cycles at both ends of a free edge become one that runs along it twice.
  void double_edge(HalfEdgeIndex h) {
    const NodeIndex u = graph_.origin(h), v = graph_.target(h);
    if (!stops_[stop_at(u)].visited() || !stops_[stop_at(v)].visited() || same_cycle(u, v)) return;
    if (doubled_node_[u] || doubled_node_[v]) return;
    const Vec2 along = graph_.position[v] - graph_.position[u];
    const Vec2 gap = strand_gap * perpendicular(along);
    // Looking from u to v: clockwise of h at u lies right of the edge, clockwise of its twin at v lies left.
    const StopIndex right_u = split_stop(u, clockwise_used(h), -gap);
    const StopIndex left_v = split_stop(v, clockwise_used(PlanarGraph::twin(h)), gap);
    connect(stop_at(u), left_v, h);
    connect(right_u, stop_at(v), h);
    join(u, v);
    doubled_node_[u] = doubled_node_[v] = true;
    ++doubled_;
  }

  /// Moves one link of a node's stop to a new stop, which it returns. The new stop lies `gap` beside the
  /// node, the old one on the other side. Each then has its first link, and no second one yet.
  StopIndex split_stop(NodeIndex node, HalfEdgeIndex moved, const Vec2& gap) {
    const StopIndex old = stop_at(node), fresh(stops_.size());
    std::array<Link, 2>& links = stops_[old].links;
    if (links[0].half_edge == moved) std::swap(links[0], links[1]);
    assert(links[1].half_edge == moved);
    const Link link = links[1];
    links[1] = {};
    for (Link& back : stops_[link.stop].links) {
      if (back.stop == old && PlanarGraph::edge(back.half_edge) == PlanarGraph::edge(moved))
        back.stop = fresh;
    }
    const Vec2 position = stops_[old].position;
    stops_[old].position = position - gap;
    stops_.push_back({position + gap, {link, {}}});
    return fresh;
  }

  void connect(StopIndex a, StopIndex b, HalfEdgeIndex h) {
    stops_[a].links[1] = {b, h};
    stops_[b].links[1] = {a, PlanarGraph::twin(h)};
  }

  /// Follows the links once around. Returns false if that does not visit every stop.
  bool trace(Cycle& cycle) {
    const StopIndex first = stops_.first_with([](const Stop& s) { return s.visited(); });
    if (!first.valid()) return false;
    std::vector<StopIndex> way;
    std::vector<HalfEdgeIndex> by;
    StopIndex here = first;
    EdgeIndex arrived = PlanarGraph::edge(stops_[first].links[1].half_edge);
    do {
      const Stop& stop = stops_[here];
      const Link& link = stop.links[PlanarGraph::edge(stop.links[0].half_edge) == arrived ? 1 : 0];
      way.push_back(here);
      by.push_back(link.half_edge);
      arrived = PlanarGraph::edge(link.half_edge);
      here = link.stop;
    } while (here != first && way.size() <= cycle.nodes);
    if (way.size() != cycle.nodes) return false;
    make_tour(cycle.tour, way, by);
    return true;
  }

  /// Makes a tour of the traced stops that runs counter-clockwise. `by` holds the half-edge that leaves each.
  void make_tour(Tour& tour, const std::vector<StopIndex>& way, const std::vector<HalfEdgeIndex>& by) {
    double twice_area = 0;
    const std::size_t n = way.size();
    for (std::size_t k = 0; k < n; ++k) {
      Ring line{stops_[way[k]].position};
      graph_.append_bends(by[k], line);
      line.push_back(stops_[way[(k + 1) % n]].position);
      for (std::size_t i = 0; i + 1 < line.size(); ++i) twice_area += cross(line[i], line[i + 1]);
    }
    const bool backwards = twice_area < 0;
    tour.next.resize(stops_.size());
    tour.before.resize(stops_.size());
    tour.leave.resize(stops_.size());
    tour.free.assign(stops_.size(), 0);
    for (const Stop& stop : stops_) tour.position.push_back(stop.position);
    for (std::size_t k = 0; k < n; ++k) {
      const StopIndex one = way[k], other = way[(k + 1) % n];
      const StopIndex from = backwards ? other : one, to = backwards ? one : other;
      tour.next[from] = to;
      tour.before[to] = from;
      tour.leave[from] = backwards ? PlanarGraph::twin(by[k]) : by[k];
      tour.free[from] = from.number() < doubled_node_.size() && !doubled_node_[NodeIndex(from.number())];
    }
    tour.graph = std::move(graph_);
  }

  RefinedGraph graph_;
  Per<EdgeIndex, bool> used_;    ///< the edge is part of a cycle
  Per<EdgeIndex, double> cost_;  ///< of a run along the edge
  bool has_cost_;
  Per<NodeIndex, FaceIndex> cell_of_centre_;  ///< for centres only
  Per<HalfEdgeIndex, FaceIndex> cell_of_;     ///< the cell on the left, for half-edges of the cell graph
  DisjointSets sets_;                         ///< nodes in the same cycle
  Per<StopIndex, Stop> stops_;
  Per<NodeIndex, bool> doubled_node_;
  std::size_t unreached_ = 0, reconnected_ = 0, doubled_ = 0;
};

}  // namespace

std::optional<Cycle> first_cycle(const CellGraph& cells, const RunCost& cost) {
  CycleCover cover(cells, cost);
  if (!cover.invert_matching()) return std::nullopt;
  cover.reach_centres();
  cover.split_and_reconnect();
  return cover.joined();
}

}  // namespace unicursal::core
