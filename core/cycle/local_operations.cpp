// The drawings of the operations show edges of the tour as rows of * and other edges as rows of dots. Edges
// that do not matter, such as the diagonals of rhombuses, are left out.
#include "core/cycle/local_operations.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

namespace unicursal::core {
namespace {

HalfEdgeIndex twin(HalfEdgeIndex h) {
  return PlanarGraph::twin(h);
}

NodeIndex after_node(NodeIndex n) {
  return ++n;
}

}  // namespace

EditableTour::EditableTour(Tour tour) : tour_(std::move(tour)), order_(tour_), movable_(tour_.free) {
  const RefinedGraph& graph = tour_.graph;
  const std::size_t halves = graph.half_edges.size();
  corners_.reserve(halves);
  for (const HalfEdgeIndex h : graph.half_edges.indices()) {
    Corner corner{graph.origin(h), {}, {}};
    const HalfEdgeIndex n = graph.next(h), p = graph.next(n);
    if (graph.face(h) != outside && graph.next(p) == h && p != n) corner.next = n, corner.previous = p;
    corners_.push_back(corner);
  }
  first_spoke_.assign(graph.node_count() + 1, 0);
  for (const HalfEdge& h : graph.half_edges) ++first_spoke_[after_node(h.origin)];
  for (const NodeIndex n : graph.position.indices()) first_spoke_[after_node(n)] += first_spoke_[n];
  spokes_.resize(halves);
  Per<NodeIndex, std::uint32_t> filled = first_spoke_;
  for (const HalfEdgeIndex h : graph.half_edges.indices()) spokes_[filled[graph.origin(h)]++] = h;
}

std::vector<TourWindow> EditableTour::divide(double side, const Vec2& corner) {
  TourWindows cut = cut_into_windows(tour_, side, corner);
  window_of_ = std::move(cut.window_of);
  movable_.assign(tour_.stop_count(), 0);
  for (const TourWindow& window : cut.windows) {
    order_.label(window.sequence);
    for (const StopIndex s : window.movable) movable_[s] = 1;
  }
  return std::move(cut.windows);
}

HalfEdgeIndex EditableTour::step(HalfEdgeIndex h, Side side) const {
  if (side == left) return after(h);
  const HalfEdgeIndex back = corners_[twin(h)].previous;
  return back.valid() ? twin(back) : back;
}

bool EditableTour::used(HalfEdgeIndex h) const {
  return leave(start(h)) == h || leave(target(h)) == twin(h);
}

HalfEdgeIndex EditableTour::random_spoke(StopIndex s, Dice& dice) const {
  const NodeIndex node(s.number());
  const std::uint32_t first = first_spoke_[node];
  return spokes_[first + dice.below(first_spoke_[after_node(node)] - first)];
}

std::optional<LocalChange> EditableTour::look(StopIndex at, Dice& dice) const {
  return look(1 + static_cast<int>(dice.below(4)), at, dice);
}

std::optional<LocalChange> EditableTour::look(int operation, StopIndex at, Dice& dice) const {
  switch (operation) {
    case 1:
      return relocate_one(at, dice);
    case 2:
      return swap_two(at);
    case 3:
      return relocate_two(at);
    default:
      return flip_two_rhombuses(at, dice);
  }
}

/// Operation 1: x leaves its place between b and c and goes between p and q.
///
///     b         q          b         q
///     . *     . *          * .     * .
///     .   * .   *          *   . *   .
///     .     x   *    →     *     x   .
///     .   * .   *          *   . *   .
///     . *     . *          * .     * .
///     c         p          c         p
std::optional<LocalChange> EditableTour::relocate_one(StopIndex x, Dice& dice) const {
  const StopIndex b = tour_.before[x], c = tour_.next[x];
  if (!movable(b) || !movable(c) || b == c) return std::nullopt;
  Side side = left;
  if (step(leave(b), left) != leave(x)) {
    side = right;
    if (step(leave(b), right) != leave(x)) return std::nullopt;
  }
  const HalfEdgeIndex closing = step(leave(x), side);  // c → b

  const HalfEdgeIndex spoke = random_spoke(x, dice);  // x → p, the triangle on its left
  const HalfEdgeIndex across = step(spoke, left);     // p → q
  if (!across.valid()) return std::nullopt;
  const HalfEdgeIndex home = step(across, left);  // q → x
  const StopIndex p = target(spoke), q = start(home);
  if (!movable(p) || !movable(q) || used(spoke) || used(home)) return std::nullopt;
  if (side == left && leave(q) == twin(across)) {
    return LocalChange{1, {{{b, twin(closing)}, {q, home}, {x, spoke}, {}}}, 3};
  }
  if (side == right && leave(p) == across) {
    return LocalChange{1, {{{b, twin(closing)}, {p, twin(spoke)}, {x, twin(home)}, {}}}, 3};
  }
  return std::nullopt;
}

/// Operation 2: a x y b becomes a y x b.
///
///           x                    x
///         * * .                . * *
///       *   *   .            .   *   *
///     a     *     b    →   a     *     b
///       .   *   *            *   *   .
///         . * *                * * .
///           y                    y
std::optional<LocalChange> EditableTour::swap_two(StopIndex x) const {
  const StopIndex a = tour_.before[x], y = tour_.next[x];
  if (!movable(a) || !movable(y)) return std::nullopt;
  const StopIndex b = tour_.next[y];
  if (!movable(b) || a == b || a == y) return std::nullopt;
  const HalfEdgeIndex h = leave(x);
  for (const Side side : {left, right}) {
    const Side other = side == left ? right : left;
    const HalfEdgeIndex y_a = step(h, side);
    if (!y_a.valid() || step(y_a, side) != leave(a)) continue;
    if (step(h, other) != leave(y)) continue;
    const HalfEdgeIndex b_x = step(leave(y), other);
    return LocalChange{2, {{{a, twin(y_a)}, {y, twin(h)}, {x, twin(b_x)}, {}}}, 3};
  }
  return std::nullopt;
}

/// Operation 3: x and y leave their place between a and b on one side and go between w and z on the other.
/// Each of the two rhombuses consists of two triangles, with either of its diagonals.
///
///     a * * * x . . . w          a . . . x * * * w
///     .       *       *          *       *       .
///     .       *       *    →     *       *       .
///     b * * * y . . . z          b . . . y * * * z
std::optional<LocalChange> EditableTour::relocate_two(StopIndex x) const {
  const StopIndex a = tour_.before[x], y = tour_.next[x];
  if (!movable(a) || !movable(y)) return std::nullopt;
  const StopIndex b = tour_.next[y];
  if (!movable(b) || a == b || a == y) return std::nullopt;
  const HalfEdgeIndex h = leave(x);
  for (const Side side : {left, right}) {
    const HalfEdgeIndex turn = step(h, side);
    if (!turn.valid()) continue;
    HalfEdgeIndex closing;   // b → a
    if (turn == leave(y)) {  // the diagonal is b → x
      const HalfEdgeIndex diagonal = step(turn, side);
      const HalfEdgeIndex across = step(twin(diagonal), side);
      if (across.valid() && step(across, side) == leave(a)) closing = across;
    } else if (step(turn, side) == leave(a)) {  // the diagonal is y → a
      if (step(twin(turn), side) == leave(y)) closing = step(leave(y), side);
    }
    if (!closing.valid()) continue;

    const Side other = side == left ? right : left;
    const HalfEdgeIndex y_z = step(h, other);
    if (!y_z.valid() || used(y_z)) continue;
    const HalfEdgeIndex z_x = step(y_z, other);
    if (used(z_x)) continue;
    const StopIndex z = target(y_z);
    if (!movable(z)) continue;
    const HalfEdgeIndex z_w = step(twin(z_x), other);  // the diagonal is z x: rhombus x y z w
    if (z_w.valid() && leave(z) == z_w && target(z_w) != y) {
      const HalfEdgeIndex w_x = step(z_w, other);
      if (movable(target(z_w)) && !used(w_x)) {
        return LocalChange{3, {{{a, twin(closing)}, {z, twin(y_z)}, {y, twin(h)}, {x, twin(w_x)}}}, 4};
      }
    }
    const HalfEdgeIndex y_w = step(twin(y_z), other);  // the diagonal is y z: rhombus x y w z
    if (y_w.valid() && !used(y_w) && target(y_w) != x) {
      const HalfEdgeIndex w_z = step(y_w, other);
      const StopIndex w = target(y_w);
      if (movable(w) && leave(w) == w_z) {
        return LocalChange{3, {{{a, twin(closing)}, {w, twin(y_w)}, {y, twin(h)}, {x, twin(z_x)}}}, 4};
      }
    }
  }
  return std::nullopt;
}

std::optional<EditableTour::Rhombus> EditableTour::rhombus_about(HalfEdgeIndex diagonal) const {
  const HalfEdgeIndex l1 = after(diagonal), r1 = after(twin(diagonal));
  if (!l1.valid() || !r1.valid() || used(diagonal)) return std::nullopt;
  std::array<HalfEdgeIndex, 4> side{l1, after(l1), r1, after(r1)};
  for (const HalfEdgeIndex s : side) {
    if (!movable(start(s))) return std::nullopt;
  }
  if (!used(side[0])) std::rotate(side.begin(), side.begin() + 1, side.end());
  if (!used(side[0]) || used(side[1]) || !used(side[2]) || used(side[3])) return std::nullopt;
  return Rhombus{side, leave(start(side[0])) == side[0]};
}

/// Operation 4: the rhombus a b c d lies inside, the rhombus p q r s outside, and they share a corner, here c
/// and p. The flip of a b c d cuts the tour into b … c and d … a; the flip of p q r s joins the two halves if
/// each of them contains one of the used sides p q and r s.
///
///             s * * * r                  s . . . r
///             .       .                  *       *
///     d * * * c * * * q    →     d . . . c . . . q
///     .       .                  *       *
///     a * * * b                  a . . . b
std::optional<LocalChange> EditableTour::flip_two_rhombuses(StopIndex x, Dice& dice) const {
  const HalfEdgeIndex one = random_spoke(x, dice), two = random_spoke(x, dice);
  const auto diagonal = [&](HalfEdgeIndex spoke) { return dice.below(2) == 0 ? spoke : after(spoke); };
  const HalfEdgeIndex d1 = diagonal(one), d2 = diagonal(two);
  if (!d1.valid() || !d2.valid()) return std::nullopt;
  const std::optional<Rhombus> first = rhombus_about(d1);
  if (!first) return std::nullopt;
  const std::optional<Rhombus> second = rhombus_about(d2);
  if (!second || first->inside == second->inside) return std::nullopt;
  const auto& in = first->inside ? first->side : second->side;
  const auto& out = first->inside ? second->side : first->side;
  for (const std::size_t i : {0, 2}) {
    for (const std::size_t o : {0, 2}) {
      if (in[i] == twin(out[o])) return std::nullopt;
    }
  }
  const StopIndex b = start(in[1]), c = target(in[1]);
  const StopIndex q = start(out[1]), s = start(out[3]);
  if (order_.within(b, q, c) == order_.within(b, s, c)) return std::nullopt;
  return LocalChange{4, {{{c, twin(in[1])}, {target(in[3]), twin(in[3])}, {q, out[1]}, {s, out[3]}}}, 4};
}

EditableTour::Blocks EditableTour::blocks_of(const LocalChange& change) const {
  const auto& d = change.departures;
  const StopIndex c = d[0].stop, a = d[1].stop, b = tour_.next[a];
  StopIndex q = d[2].stop, s = d[3].stop;
  if (!order_.within(b, q, c)) std::swap(q, s);
  return {{{b, q}, {tour_.next[s], a}, {tour_.next[c], s}, {tour_.next[q], c}}};
}

EditableTour::Marks EditableTour::leaving(const Blocks& blocks, const TourWindow& window) const {
  Marks marks{};
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    // No block begins at an entry, since the links that are cut do not cross the window's border.
    marks[k] = std::any_of(window.entries.begin(), window.entries.end(), [&](StopIndex entry) {
      return order_.within(blocks[k].first, entry, blocks[k].last);
    });
  }
  return marks;
}

bool EditableTour::keeps_ends(const LocalChange& change, const TourWindow& window) const {
  if (change.operation != 4 || window.entries.empty()) return true;
  // The blocks' new order is the reverse of the old one, up to where it begins. Two keep their neighbours in
  // it.
  const Marks marks = leaving(blocks_of(change), window);
  return std::count(marks.begin(), marks.end(), true) <= 2;
}

void EditableTour::apply(const LocalChange& change, TourWindow& window) {
  const auto& d = change.departures;
  Blocks blocks{};
  Marks marks{};
  if (change.operation == 4) {
    blocks = blocks_of(change);
    marks = leaving(blocks, window);
  }
  for (std::size_t k = 0; k < change.count; ++k) {
    const Departure& departure = d[k];
    const StopIndex to = target(departure.by);
    tour_.leave[departure.stop] = departure.by;
    tour_.next[departure.stop] = to;
    tour_.before[to] = departure.stop;
  }
  switch (change.operation) {
    case 1:
      return fit(d[2].stop, d[2].stop, window);
    case 2:
      return order_.swap(d[1].stop, d[2].stop);
    case 3:
      return fit(d[2].stop, d[3].stop, window);
    default:
      return relabel(blocks, marks, window);
  }
}

/// Only two of the four blocks are relabelled, the shortest of those that stay in the window: the two others
/// are in order in any case.
void EditableTour::relabel(const Blocks& blocks, const Marks& leaving, TourWindow& window) {
  std::array<StopIndex, 4> walker{};
  for (std::size_t k = 0; k < 4; ++k) walker[k] = blocks[k].first;
  Marks moves{};
  for (int found = 0; found < 2;) {
    for (std::size_t k = 0; k < 4 && found < 2; ++k) {
      if (moves[k] || leaving[k]) continue;
      if (walker[k] == blocks[k].last) {
        moves[k] = true;
        ++found;
      }
      walker[k] = tour_.next[walker[k]];
    }
  }
  for (std::size_t k = 0; k < 4; ++k) {
    const std::size_t after = (k + 1) % 4, before = (k + 3) % 4;
    if (!moves[k] || moves[before]) continue;
    fit(blocks[k].first, moves[after] ? blocks[after].last : blocks[k].last, window);
  }
}

void EditableTour::fit(StopIndex first, StopIndex last, TourWindow& window) {
  const std::uint64_t labelled = order_.fit(tour_, first, last);
  window.labelled += labelled;
  if (labelled == 0) label_all(window);
}

void EditableTour::label_all(TourWindow& window) {
  if (window.entries.empty()) {
    const StopIndex start = window.sequence.front();
    window.sequence.clear();
    StopIndex stop = start;
    do {
      window.sequence.push_back(stop);
      stop = tour_.next[stop];
    } while (stop != start);
  } else {
    window.sequence.clear();
    for (const StopIndex entry : window.entries) {
      for (StopIndex s = entry; window_of_[s] == window_of_[entry]; s = tour_.next[s])
        window.sequence.push_back(s);
    }
  }
  order_.label(window.sequence);
  window.labelled += window.sequence.size();
}

bool EditableTour::consistent() const {
  const StopIndex first = tour_.first_visited();
  if (!first.valid()) return true;
  const StopIndex last = tour_.before[first];
  const std::size_t visited = tour_.visited_count();
  std::size_t seen = 0;
  StopIndex stop = first;
  do {
    const StopIndex to = tour_.next[stop];
    if (tour_.before[to] != stop) return false;
    if (stop != last && (!order_.within(first, stop, to) || !order_.within(stop, to, last))) return false;
    if (movable(stop) && start(leave(stop)) != stop) return false;
    if (movable(to) && target(leave(stop)) != to) return false;
    stop = to;
  } while (stop != first && ++seen <= visited);
  return seen + 1 == visited;
}

}  // namespace unicursal::core
