#include "core/cycle/first_cycle.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <deque>
#include <numeric>
#include <utility>
#include <vector>

#include "core/graph/matching.hpp"
#include "core/graph/refined_graph.hpp"

namespace unicursal::core {
namespace {

constexpr double cost_steps = 1e5;   ///< whole numbers that the largest cost is told apart into
constexpr double strand_gap = 0.02;  ///< half the gap between the strands of a doubled edge, in edge lengths

class DisjointSets {
 public:
  explicit DisjointSets(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0); }
  int find(int i) {
    while (parent_[static_cast<std::size_t>(i)] != i) {
      int& up = parent_[static_cast<std::size_t>(i)];
      i = up = parent_[static_cast<std::size_t>(up)];
    }
    return i;
  }
  void join(int a, int b) { parent_[static_cast<std::size_t>(find(a))] = find(b); }

 private:
  std::vector<int> parent_;
};

/// A set of edges that gives every node two: first several cycles, in the end one.
class CycleCover {
 public:
  CycleCover(const CellGraph& cells, const RunCost& cost)
      : graph_(refine(cells)),
        used_(graph_.edge_count(), false),
        cost_(graph_.edge_count(), 0.0),
        has_cost_(static_cast<bool>(cost)) {
    if (!has_cost_) return;
    for (std::size_t e = 0; e < cost_.size(); ++e) {
      const auto h = static_cast<HalfEdgeIndex>(2 * e);
      Ring line{graph_.position[static_cast<std::size_t>(graph_.origin(h))]};
      graph_.append_bends(h, line);
      line.push_back(graph_.position[static_cast<std::size_t>(graph_.target(h))]);
      for (std::size_t i = 0; i + 1 < line.size(); ++i) cost_[e] += cost(line[i], line[i + 1]);
    }
  }

  /// The inverse of a perfect matching covers every node of the cell graph with cycles.
  bool invert_matching() {
    std::vector<std::pair<int, int>> edges;
    for (EdgeIndex e = 0; e < static_cast<EdgeIndex>(graph_.cell_edges); ++e) {
      edges.emplace_back(graph_.origin(2 * e), graph_.target(2 * e));
    }
    const auto nodes = static_cast<int>(graph_.cell_nodes);
    const std::vector<bool> matched =
        has_cost_ ? heaviest_perfect_matching(nodes, edges, whole_costs()) : perfect_matching(nodes, edges);
    if (matched.empty()) return false;
    for (std::size_t e = 0; e < matched.size(); ++e) used_[e] = !matched[e];
    return true;
  }

  /// Every centre takes the place of one used side of its cell. The paper lets cells steal sides from one
  /// another and freezes them; serving the cells with one side left first finds the same without stealing.
  void reach_centres() {
    const std::size_t cells = graph_.centre.size();
    std::vector<int> choices(cells, 0);
    cell_of_.assign(graph_.half_edges.size(), outside);
    for (std::size_t h = 0; h < 2 * graph_.cell_edges; ++h) {
      const FaceIndex cell = cell_left_of(static_cast<HalfEdgeIndex>(h));
      cell_of_[h] = cell;
      if (cell != outside && used_[h / 2]) ++choices[static_cast<std::size_t>(cell)];
    }
    std::deque<FaceIndex> urgent;
    for (std::size_t c = 0; c < cells; ++c) {
      if (graph_.centre[c] >= 0 && choices[c] == 1) urgent.push_back(static_cast<FaceIndex>(c));
    }
    std::vector<bool> served(cells, false);
    for (std::size_t c = 0; c < cells; ++c) {
      serve(urgent, choices, served);
      if (graph_.centre[c] < 0 || served[c]) continue;
      urgent.push_back(static_cast<FaceIndex>(c));
      serve(urgent, choices, served);
    }
  }

  /// Cheapest joins first; each may open the way for others.
  void split_and_reconnect() {
    label();
    for (bool changed = true; changed;) {
      changed = false;
      std::vector<Reconnection> found;
      for (EdgeIndex e = 0; e < static_cast<EdgeIndex>(graph_.edge_count()); ++e) {
        if (const auto r = reconnection_about(e)) found.push_back(*r);
      }
      std::stable_sort(found.begin(), found.end(),
                       [](const Reconnection& l, const Reconnection& r) { return l.cost < r.cost; });
      for (const Reconnection& r : found) {
        // An earlier one may have changed the neighbourhood.
        const auto now = reconnection_about(r.diagonal);
        if (!now) continue;
        apply(*now);
        changed = true;
      }
    }
  }

  /// Nothing if some cycles cannot be joined.
  std::optional<Cycle> joined() {
    make_stops();
    for (EdgeIndex e = 0; e < static_cast<EdgeIndex>(graph_.edge_count()); ++e) {
      if (!used_[static_cast<std::size_t>(e)] && graph_.bends(2 * e).empty()) double_edge(2 * e);
    }
    Cycle cycle;
    cycle.nodes = static_cast<std::size_t>(
        std::count_if(stops_.begin(), stops_.end(), [](const Stop& s) { return s.links[1].stop >= 0; }));
    cycle.unreached_centres =
        unreached_ + static_cast<std::size_t>(std::count(graph_.centre.begin(), graph_.centre.end(), -1));
    cycle.split_and_reconnect = reconnected_;
    cycle.doubled_edges = doubled_;
    if (!trace(cycle)) return std::nullopt;
    return cycle;
  }

 private:
  struct Link {
    int stop = -1;
    HalfEdgeIndex half_edge = -1;  ///< leaving the node
  };
  /// A visit of the cycle to a node; doubled nodes are visited twice.
  struct Stop {
    Vec2 position{0, 0};
    std::array<Link, 2> links;
  };

  FaceIndex cell_left_of(HalfEdgeIndex h) const {
    const FaceIndex face = graph_.face(h);
    if (face == outside) return outside;
    // A triangle's third corner is its cell's centre; a cell without centre kept its own face.
    const NodeIndex third = graph_.target(graph_.next(h));
    if (!graph_.is_centre(third)) return face;
    return centre_cell(third);
  }

  FaceIndex centre_cell(NodeIndex centre) const {
    if (cell_of_centre_.empty()) {
      cell_of_centre_.assign(graph_.node_count() - graph_.cell_nodes, outside);
      for (std::size_t c = 0; c < graph_.centre.size(); ++c) {
        if (graph_.centre[c] >= 0) {
          cell_of_centre_[static_cast<std::size_t>(graph_.centre[c]) - graph_.cell_nodes] =
              static_cast<FaceIndex>(c);
        }
      }
    }
    return cell_of_centre_[static_cast<std::size_t>(centre) - graph_.cell_nodes];
  }

  void serve(std::deque<FaceIndex>& urgent, std::vector<int>& choices, std::vector<bool>& served) {
    while (!urgent.empty()) {
      const auto cell = static_cast<std::size_t>(urgent.front());
      urgent.pop_front();
      if (served[cell]) continue;
      served[cell] = true;
      const HalfEdgeIndex side = pick_side(static_cast<FaceIndex>(cell), choices);
      if (side < 0) {
        ++unreached_;
        continue;
      }
      const HalfEdgeIndex back = graph_.next(side);
      for (const HalfEdgeIndex h : {back, graph_.next(back)}) used_[static_cast<std::size_t>(h / 2)] = true;
      used_[static_cast<std::size_t>(side / 2)] = false;
      const FaceIndex neighbour = cell_of_[static_cast<std::size_t>(PlanarGraph::twin(side))];
      if (neighbour == outside) continue;
      if (--choices[static_cast<std::size_t>(neighbour)] == 1 &&
          graph_.centre[static_cast<std::size_t>(neighbour)] >= 0) {
        urgent.push_back(neighbour);
      }
    }
  }

  /// The used side of the cell whose way over the centre costs least; among equals one on the border (nobody
  /// else needs it, and bends go away with it), then one whose neighbour has most to choose from.
  HalfEdgeIndex pick_side(FaceIndex cell, const std::vector<int>& choices) const {
    HalfEdgeIndex best = -1;
    std::pair<double, int> best_rank;
    const HalfEdgeIndex start = graph_.face_start[static_cast<std::size_t>(cell)];
    HalfEdgeIndex side = start;
    do {
      const HalfEdgeIndex back = graph_.next(side);
      if (used_[static_cast<std::size_t>(side / 2)]) {
        const FaceIndex neighbour = cell_of_[static_cast<std::size_t>(PlanarGraph::twin(side))];
        const int freedom = neighbour == outside ? 1 << 20 : choices[static_cast<std::size_t>(neighbour)];
        const std::pair rank(cost(back) + cost(graph_.next(back)) - cost(side), -freedom);
        if (best < 0 || rank < best_rank) best = side, best_rank = rank;
      }
      side = graph_.next(PlanarGraph::twin(back));  // the next triangle around the centre
    } while (side != start);
    return best;
  }

  void label() {
    sets_ = DisjointSets(graph_.node_count());
    for (EdgeIndex e = 0; e < static_cast<EdgeIndex>(graph_.edge_count()); ++e) {
      if (used_[static_cast<std::size_t>(e)]) sets_.join(graph_.origin(2 * e), graph_.target(2 * e));
    }
  }

  bool used_half(HalfEdgeIndex h) const { return used_[static_cast<std::size_t>(h / 2)]; }

  bool triangle(HalfEdgeIndex h) const {
    return graph_.face(h) != outside && graph_.next(graph_.next(graph_.next(h))) == h;
  }

  /// Figure 7: opposite sides of a quad in two cycles, the other two sides free.
  struct Reconnection {
    EdgeIndex diagonal = -1;
    std::array<HalfEdgeIndex, 2> leave{}, take{};
    double cost = 0;
  };

  std::optional<Reconnection> reconnection_about(EdgeIndex e) {
    const HalfEdgeIndex left = 2 * e, right = 2 * e + 1;
    if (used_half(left) || !triangle(left) || !triangle(right)) return std::nullopt;
    if (sets_.find(graph_.origin(left)) == sets_.find(graph_.origin(right))) return std::nullopt;
    const HalfEdgeIndex l1 = graph_.next(left), l2 = graph_.next(l1);
    const HalfEdgeIndex r1 = graph_.next(right), r2 = graph_.next(r1);
    if (graph_.target(l1) == graph_.target(r1)) return std::nullopt;
    for (const auto& [a, b, c, d] : {std::array{l1, r1, l2, r2}, std::array{l2, r2, l1, r1}}) {
      if (!used_half(a) || !used_half(b) || used_half(c) || used_half(d)) continue;
      return Reconnection{e, {a, b}, {c, d}, cost(c) + cost(d) - cost(a) - cost(b)};
    }
    return std::nullopt;
  }

  void apply(const Reconnection& r) {
    for (const HalfEdgeIndex h : r.leave) used_[static_cast<std::size_t>(h / 2)] = false;
    for (const HalfEdgeIndex h : r.take) used_[static_cast<std::size_t>(h / 2)] = true;
    sets_.join(graph_.origin(2 * r.diagonal), graph_.target(2 * r.diagonal));
    ++reconnected_;
  }

  double cost(HalfEdgeIndex h) const { return cost_[static_cast<std::size_t>(h / 2)]; }

  /// The cell edges' costs as whole numbers, for exact duals.
  std::vector<int> whole_costs() const {
    const auto last = cost_.begin() + static_cast<std::ptrdiff_t>(graph_.cell_edges);
    double largest = 1e-300;
    std::for_each(cost_.begin(), last, [&](double c) { largest = std::max(largest, std::abs(c)); });
    std::vector<int> result;
    std::transform(cost_.begin(), last, std::back_inserter(result),
                   [&](double c) { return static_cast<int>(std::lround(cost_steps * c / largest)); });
    return result;
  }

  void make_stops() {
    stops_.resize(graph_.node_count());
    for (std::size_t n = 0; n < stops_.size(); ++n) stops_[n].position = graph_.position[n];
    for (HalfEdgeIndex h = 0; h < static_cast<HalfEdgeIndex>(graph_.half_edges.size()); ++h) {
      if (!used_half(h)) continue;
      Stop& stop = stops_[static_cast<std::size_t>(graph_.origin(h))];
      stop.links[stop.links[0].stop < 0 ? 0 : 1] = {graph_.target(h), h};
    }
    doubled_node_.assign(graph_.node_count(), false);
  }

  /// The first used half-edge clockwise of `h` about its origin.
  HalfEdgeIndex clockwise_used(HalfEdgeIndex h) const {
    do {
      h = graph_.next(PlanarGraph::twin(h));
    } while (!used_half(h));
    return h;
  }

  /// Figure 8: the cycles at both ends of a free edge become one that runs along it twice.
  void double_edge(HalfEdgeIndex h) {
    const NodeIndex u = graph_.origin(h), v = graph_.target(h);
    const auto has_stop = [&](NodeIndex n) { return stops_[static_cast<std::size_t>(n)].links[1].stop >= 0; };
    if (!has_stop(u) || !has_stop(v) || sets_.find(u) == sets_.find(v)) return;
    if (doubled_node_[static_cast<std::size_t>(u)] || doubled_node_[static_cast<std::size_t>(v)]) return;
    const Vec2 along =
        graph_.position[static_cast<std::size_t>(v)] - graph_.position[static_cast<std::size_t>(u)];
    const Vec2 gap = strand_gap * perpendicular(along);
    // Looking from u to v: clockwise of h at u lies right of the edge, clockwise of its twin at v lies left.
    const int right_u = split_stop(u, clockwise_used(h), -gap);
    const int left_v = split_stop(v, clockwise_used(PlanarGraph::twin(h)), gap);
    connect(u, left_v, h);
    connect(right_u, v, h);
    sets_.join(u, v);
    doubled_node_[static_cast<std::size_t>(u)] = doubled_node_[static_cast<std::size_t>(v)] = true;
    ++doubled_;
  }

  /// Moves one link of a node's stop to a new stop, shifted by `gap`; the old one shifts the other way.
  /// Each keeps its first link and waits for its second.
  int split_stop(NodeIndex node, HalfEdgeIndex moved, const Vec2& gap) {
    const auto old = static_cast<std::size_t>(node);
    const int fresh = static_cast<int>(stops_.size());
    std::array<Link, 2>& links = stops_[old].links;
    if (links[0].half_edge == moved) std::swap(links[0], links[1]);
    assert(links[1].half_edge == moved);
    const Link link = links[1];
    links[1] = {};
    for (Link& back : stops_[static_cast<std::size_t>(link.stop)].links) {
      if (back.stop == node && PlanarGraph::edge(back.half_edge) == PlanarGraph::edge(moved))
        back.stop = fresh;
    }
    const Vec2 position = stops_[old].position;
    stops_[old].position = position - gap;
    stops_.push_back({position + gap, {link, {}}});
    return fresh;
  }

  void connect(int a, int b, HalfEdgeIndex h) {
    stops_[static_cast<std::size_t>(a)].links[1] = {b, h};
    stops_[static_cast<std::size_t>(b)].links[1] = {a, PlanarGraph::twin(h)};
  }

  /// Follows the links round; false when that does not visit every stop.
  bool trace(Cycle& cycle) {
    const auto start =
        std::find_if(stops_.begin(), stops_.end(), [](const Stop& s) { return s.links[1].stop >= 0; });
    if (start == stops_.end()) return false;
    const int first = static_cast<int>(start - stops_.begin());
    std::vector<int> way;
    std::vector<HalfEdgeIndex> by;
    int here = first;
    EdgeIndex arrived = PlanarGraph::edge(start->links[1].half_edge);
    do {
      const Stop& stop = stops_[static_cast<std::size_t>(here)];
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

  /// Counter-clockwise, whichever way it was traced.
  void make_tour(Tour& tour, std::vector<int>& way, std::vector<HalfEdgeIndex>& by) {
    double twice_area = 0;
    const std::size_t n = way.size();
    for (std::size_t k = 0; k < n; ++k) {
      Ring line{stops_[static_cast<std::size_t>(way[k])].position};
      graph_.append_bends(by[k], line);
      line.push_back(stops_[static_cast<std::size_t>(way[(k + 1) % n])].position);
      for (std::size_t i = 0; i + 1 < line.size(); ++i) twice_area += cross(line[i], line[i + 1]);
    }
    const bool backwards = twice_area < 0;
    tour.next.assign(stops_.size(), -1);
    tour.before.assign(stops_.size(), -1);
    tour.leave.assign(stops_.size(), -1);
    tour.free.assign(stops_.size(), 0);
    for (const Stop& stop : stops_) tour.position.push_back(stop.position);
    for (std::size_t k = 0; k < n; ++k) {
      const int from = backwards ? way[(k + 1) % n] : way[k], to = backwards ? way[k] : way[(k + 1) % n];
      const auto f = static_cast<std::size_t>(from);
      tour.next[f] = to;
      tour.before[static_cast<std::size_t>(to)] = from;
      tour.leave[f] = backwards ? PlanarGraph::twin(by[k]) : by[k];
      tour.free[f] = f < doubled_node_.size() && !doubled_node_[f];
    }
    tour.graph = std::move(graph_);
  }

  RefinedGraph graph_;
  std::vector<bool> used_;    ///< per edge: part of a cycle
  std::vector<double> cost_;  ///< per edge: of running along it
  bool has_cost_;
  std::vector<FaceIndex> cell_of_;  ///< per half-edge of the cell graph
  mutable std::vector<FaceIndex> cell_of_centre_;
  DisjointSets sets_{0};
  std::vector<Stop> stops_;
  std::vector<bool> doubled_node_;
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
