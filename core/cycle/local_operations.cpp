#include "core/cycle/local_operations.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

namespace unicursal::core {
namespace {

HalfEdgeIndex twin(HalfEdgeIndex h) {
  return PlanarGraph::twin(h);
}

}  // namespace

EditableTour::EditableTour(Tour tour) : tour_(std::move(tour)), order_(tour_) {
  const RefinedGraph& graph = tour_.graph;
  const std::size_t halves = graph.half_edges.size();
  next_.assign(halves, -1);
  previous_.assign(halves, -1);
  for (HalfEdgeIndex h = 0; h < static_cast<HalfEdgeIndex>(halves); ++h) {
    const HalfEdgeIndex n = graph.next(h), p = graph.next(n);
    if (graph.face(h) == outside || graph.next(p) != h || p == n) continue;
    next_[static_cast<std::size_t>(h)] = n;
    previous_[static_cast<std::size_t>(h)] = p;
  }
  first_spoke_.assign(graph.node_count() + 1, 0);
  for (const HalfEdge& h : graph.half_edges) ++first_spoke_[static_cast<std::size_t>(h.origin) + 1];
  for (std::size_t n = 0; n < graph.node_count(); ++n) first_spoke_[n + 1] += first_spoke_[n];
  spokes_.resize(halves);
  std::vector<std::uint32_t> filled = first_spoke_;
  for (std::size_t h = 0; h < halves; ++h) {
    spokes_[filled[static_cast<std::size_t>(graph.half_edges[h].origin)]++] = static_cast<HalfEdgeIndex>(h);
  }
  for (std::size_t s = 0; s < graph.node_count(); ++s) {
    if (tour_.free[s]) free_stops_.push_back(static_cast<StopIndex>(s));
  }
}

HalfEdgeIndex EditableTour::step(HalfEdgeIndex h, int side) const {
  if (side == 0) return next_[static_cast<std::size_t>(h)];
  const HalfEdgeIndex back = previous_[static_cast<std::size_t>(twin(h))];
  return back < 0 ? -1 : twin(back);
}

bool EditableTour::used(HalfEdgeIndex h) const {
  return leave(tour_.graph.origin(h)) == h || leave(tour_.graph.target(h)) == twin(h);
}

HalfEdgeIndex EditableTour::random_spoke(StopIndex s, Random& random) const {
  const std::size_t first = first_spoke_[static_cast<std::size_t>(s)];
  return spokes_[first + random.below(first_spoke_[static_cast<std::size_t>(s) + 1] - first)];
}

std::optional<LocalChange> EditableTour::look(StopIndex at, Random& random) const {
  return look(1 + static_cast<int>(random.below(4)), at, random);
}

std::optional<LocalChange> EditableTour::look(int operation, StopIndex at, Random& random) const {
  switch (operation) {
    case 1:
      return relocate_one(at, random);
    case 2:
      return swap_two(at);
    case 3:
      return relocate_two(at);
    default:
      return flip_two_rhombuses(at, random);
  }
}

/// Operation 1: the triangle of x and its two neighbours changes sides, and one of x with two others.
std::optional<LocalChange> EditableTour::relocate_one(StopIndex x, Random& random) const {
  const StopIndex b = tour_.before[static_cast<std::size_t>(x)];
  const StopIndex c = tour_.next[static_cast<std::size_t>(x)];
  if (!free(b) || !free(c) || b == c) return std::nullopt;
  int side = 0;
  while (side < 2 && step(leave(b), side) != leave(x)) ++side;
  if (side == 2) return std::nullopt;
  const HalfEdgeIndex closing = step(leave(x), side);  // c → b

  const HalfEdgeIndex spoke = random_spoke(x, random);  // x → t1, the triangle to its left
  const HalfEdgeIndex across = step(spoke, 0);          // t1 → t2
  if (across < 0) return std::nullopt;
  const HalfEdgeIndex home = step(across, 0);  // t2 → x
  const StopIndex t1 = tour_.graph.target(spoke), t2 = tour_.graph.origin(home);
  if (!free(t1) || !free(t2) || used(spoke) || used(home)) return std::nullopt;
  if (side == 0 && leave(t2) == twin(across)) {
    return LocalChange{1, {{{b, twin(closing)}, {t2, home}, {x, spoke}, {}}}, 3};
  }
  if (side == 1 && leave(t1) == across) {
    return LocalChange{1, {{{b, twin(closing)}, {t1, twin(spoke)}, {x, twin(home)}, {}}}, 3};
  }
  return std::nullopt;
}

/// Operation 2: a x y b becomes a y x b.
std::optional<LocalChange> EditableTour::swap_two(StopIndex x) const {
  const StopIndex a = tour_.before[static_cast<std::size_t>(x)];
  const StopIndex y = tour_.next[static_cast<std::size_t>(x)];
  if (!free(a) || !free(y)) return std::nullopt;
  const StopIndex b = tour_.next[static_cast<std::size_t>(y)];
  if (!free(b) || a == b || a == y) return std::nullopt;
  const HalfEdgeIndex h = leave(x);
  for (const int side : {0, 1}) {
    const HalfEdgeIndex y_a = step(h, side);
    if (y_a < 0 || step(y_a, side) != leave(a)) continue;
    if (step(h, 1 - side) != leave(y)) continue;
    const HalfEdgeIndex b_x = step(leave(y), 1 - side);
    return LocalChange{2, {{{a, twin(y_a)}, {y, twin(h)}, {x, twin(b_x)}, {}}}, 3};
  }
  return std::nullopt;
}

/// Operation 3: x y leave their place between a and b on one side and go between z and w on the other.
std::optional<LocalChange> EditableTour::relocate_two(StopIndex x) const {
  const StopIndex a = tour_.before[static_cast<std::size_t>(x)];
  const StopIndex y = tour_.next[static_cast<std::size_t>(x)];
  if (!free(a) || !free(y)) return std::nullopt;
  const StopIndex b = tour_.next[static_cast<std::size_t>(y)];
  if (!free(b) || a == b || a == y) return std::nullopt;
  const HalfEdgeIndex h = leave(x);
  for (const int side : {0, 1}) {
    const HalfEdgeIndex turn = step(h, side);
    if (turn < 0) continue;
    HalfEdgeIndex closing = -1;  // b → a
    if (turn == leave(y)) {      // the diagonal is b → x
      const HalfEdgeIndex diagonal = step(turn, side);
      const HalfEdgeIndex across = step(twin(diagonal), side);
      if (across >= 0 && step(across, side) == leave(a)) closing = across;
    } else if (step(turn, side) == leave(a)) {  // the diagonal is y → a
      if (step(twin(turn), side) == leave(y)) closing = step(leave(y), side);
    }
    if (closing < 0) continue;

    const int other = 1 - side;
    const HalfEdgeIndex y_z = step(h, other);
    if (y_z < 0 || used(y_z)) continue;
    const HalfEdgeIndex z_x = step(y_z, other);
    if (used(z_x)) continue;
    const StopIndex z = tour_.graph.target(y_z);
    if (!free(z)) continue;
    const HalfEdgeIndex z_w = step(twin(z_x), other);  // the diagonal is z x: rhombus x y z w
    if (z_w >= 0 && leave(z) == z_w && tour_.graph.target(z_w) != y) {
      const HalfEdgeIndex w_x = step(z_w, other);
      if (free(tour_.graph.target(z_w)) && !used(w_x)) {
        return LocalChange{3, {{{a, twin(closing)}, {z, twin(y_z)}, {y, twin(h)}, {x, twin(w_x)}}}, 4};
      }
    }
    const HalfEdgeIndex y_w = step(twin(y_z), other);  // the diagonal is y z: rhombus x y w z
    if (y_w >= 0 && !used(y_w) && tour_.graph.target(y_w) != x) {
      const HalfEdgeIndex w_z = step(y_w, other);
      const StopIndex w = tour_.graph.target(y_w);
      if (free(w) && leave(w) == w_z) {
        return LocalChange{3, {{{a, twin(closing)}, {w, twin(y_w)}, {y, twin(h)}, {x, twin(z_x)}}}, 4};
      }
    }
  }
  return std::nullopt;
}

std::optional<EditableTour::Rhombus> EditableTour::rhombus_about(HalfEdgeIndex diagonal) const {
  const HalfEdgeIndex l1 = next_[static_cast<std::size_t>(diagonal)];
  const HalfEdgeIndex r1 = next_[static_cast<std::size_t>(twin(diagonal))];
  if (l1 < 0 || r1 < 0 || used(diagonal)) return std::nullopt;
  std::array<HalfEdgeIndex, 4> side{l1, next_[static_cast<std::size_t>(l1)], r1,
                                    next_[static_cast<std::size_t>(r1)]};
  for (const HalfEdgeIndex s : side) {
    if (!free(tour_.graph.origin(s))) return std::nullopt;
  }
  if (!used(side[0])) std::rotate(side.begin(), side.begin() + 1, side.end());
  if (!used(side[0]) || used(side[1]) || !used(side[2]) || used(side[3])) return std::nullopt;
  return Rhombus{side, leave(tour_.graph.origin(side[0])) == side[0]};
}

/// Operation 4. Flipping the rhombus inside, a b c d, cuts the tour in b … c and d … a; flipping the one
/// outside, p q r s, joins them again if it has a side on either.
std::optional<LocalChange> EditableTour::flip_two_rhombuses(StopIndex x, Random& random) const {
  const HalfEdgeIndex one = random_spoke(x, random), two = random_spoke(x, random);
  const auto diagonal = [&](HalfEdgeIndex spoke) {
    return random.below(2) == 0 ? spoke : next_[static_cast<std::size_t>(spoke)];
  };
  const HalfEdgeIndex d1 = diagonal(one), d2 = diagonal(two);
  if (d1 < 0 || d2 < 0) return std::nullopt;
  const std::optional<Rhombus> first = rhombus_about(d1);
  if (!first) return std::nullopt;
  const std::optional<Rhombus> second = rhombus_about(d2);
  if (!second || first->inside == second->inside) return std::nullopt;
  const auto& in = first->inside ? first->side : second->side;
  const auto& out = first->inside ? second->side : first->side;
  for (const int i : {0, 2}) {
    for (const int o : {0, 2}) {
      if (in[static_cast<std::size_t>(i)] == twin(out[static_cast<std::size_t>(o)])) return std::nullopt;
    }
  }
  const PlanarGraph& graph = tour_.graph;
  const StopIndex b = graph.origin(in[1]), c = graph.target(in[1]);
  const StopIndex q = graph.origin(out[1]), s = graph.origin(out[3]);
  if (order_.within(b, q, c) == order_.within(b, s, c)) return std::nullopt;
  return LocalChange{
      4, {{{c, twin(in[1])}, {graph.target(in[3]), twin(in[3])}, {q, out[1]}, {s, out[3]}}}, 4};
}

void EditableTour::apply(const LocalChange& change) {
  const auto next = [&](StopIndex s) { return tour_.next[static_cast<std::size_t>(s)]; };
  struct Block {
    StopIndex first, last;
  };
  std::array<Block, 4> blocks{};  // operation 4: in their new order
  const auto& d = change.departures;
  if (change.operation == 4) {
    const StopIndex c = d[0].stop, a = d[1].stop, b = next(a);
    StopIndex q = d[2].stop, s = d[3].stop;
    if (!order_.within(b, q, c)) std::swap(q, s);
    blocks = {{{b, q}, {next(s), a}, {next(c), s}, {next(q), c}}};
  }
  for (int k = 0; k < change.count; ++k) {
    const Departure& departure = d[static_cast<std::size_t>(k)];
    const StopIndex to = target(departure.by);
    tour_.leave[static_cast<std::size_t>(departure.stop)] = departure.by;
    tour_.next[static_cast<std::size_t>(departure.stop)] = to;
    tour_.before[static_cast<std::size_t>(to)] = departure.stop;
  }
  switch (change.operation) {
    case 1:
      order_.fit(tour_, d[2].stop, d[2].stop);
      return;
    case 2:
      order_.swap(d[1].stop, d[2].stop);
      return;
    case 3:
      order_.fit(tour_, d[2].stop, d[3].stop);
      return;
    default:
      break;
  }
  // The two shortest of the four stretches move; any two that stay are in order.
  std::array<StopIndex, 4> walker{};
  for (std::size_t k = 0; k < 4; ++k) walker[k] = blocks[k].first;
  std::array<bool, 4> moves{};
  for (int found = 0; found < 2;) {
    for (std::size_t k = 0; k < 4 && found < 2; ++k) {
      if (moves[k]) continue;
      if (walker[k] == blocks[k].last) {
        moves[k] = true;
        ++found;
      }
      walker[k] = next(walker[k]);
    }
  }
  for (std::size_t k = 0; k < 4; ++k) {
    const std::size_t after = (k + 1) % 4, before = (k + 3) % 4;
    if (!moves[k] || moves[before]) continue;
    order_.fit(tour_, blocks[k].first, moves[after] ? blocks[after].last : blocks[k].last);
  }
}

bool EditableTour::consistent() const {
  const auto start = std::find_if(tour_.next.begin(), tour_.next.end(), [](StopIndex s) { return s >= 0; });
  if (start == tour_.next.end()) return true;
  const auto first = static_cast<StopIndex>(start - tour_.next.begin());
  const StopIndex last = tour_.before[static_cast<std::size_t>(first)];
  const auto visited = static_cast<std::size_t>(
      std::count_if(tour_.next.begin(), tour_.next.end(), [](StopIndex s) { return s >= 0; }));
  std::size_t seen = 0;
  StopIndex stop = first;
  do {
    const auto s = static_cast<std::size_t>(stop);
    const StopIndex to = tour_.next[s];
    if (tour_.before[static_cast<std::size_t>(to)] != stop) return false;
    if (stop != last && (!order_.within(first, stop, to) || !order_.within(stop, to, last))) return false;
    if (free(stop) && tour_.graph.origin(tour_.leave[s]) != stop) return false;
    if (free(to) && tour_.graph.target(tour_.leave[s]) != to) return false;
    stop = to;
  } while (stop != first && ++seen <= visited);
  return seen + 1 == visited;
}

}  // namespace unicursal::core
