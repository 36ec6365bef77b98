#include "core/cycle/cycle_objective.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace unicursal::core {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double length_band = 0.1;  ///< where the reward tapers off, as a share of the target length
constexpr double flaw_share =
    0.6;  ///< a stop that earns less than this share of a full chord's reward is a flaw

/// The square of an angle from the square of its sine, within 2 %: the start of the series of arcsin², and a
/// term that makes it end at π²/4.
double squared_angle(double sine2) {
  const double u = sine2, u2 = u * u, u4 = u2 * u2;
  return u + u2 / 3 + 0.143 * u2 * u + 0.991 * u4 * u4;
}

/// ‖v‖ times the squared angle between a line along `u` (of squared length `length2`) and the direction of v.
double off_direction(const Vec2& u, double length2, const Vec2& v) {
  const double norm = v.norm();
  if (!(norm > 0) || !(length2 > 0)) return 0;
  const double cosine =
      ((u.x() * u.x() - u.y() * u.y()) * v.x() + 2 * u.x() * u.y() * v.y()) / (length2 * norm);
  return norm * squared_angle(std::clamp((1 - cosine) / 2, 0.0, 1.0));
}

}  // namespace

CycleObjective::CycleObjective(const EditableTour& tour, const DemandAt& demand, const RunCost& run_cost,
                               const ObjectiveWeights& weights)
    : tour_(tour), weights_(weights) {
  const Tour& t = tour.tour();
  for (int k = 0; k < bins; ++k) {
    const double angle = pi * k / bins;
    kernel_[k] = (pi * pi / 6 - pi * angle + angle * angle) / 2;
  }
  for (const StopIndex s : t.next.indices()) {
    if (t.visited(s)) edge_length_ += (t.position[t.next[s]] - t.position[s]).norm();
  }
  edge_length_ /= static_cast<double>(std::max<std::size_t>(t.visited_count(), 1));
  demand_.resize(t.stop_count());
  for (const StopIndex s : demand_.indices()) {
    if (demand) demand_[s] = demand(t.position[s]);
    const EvenZoneIndex zone = demand_[s].even_zone;
    if (zone.valid() && zone.number() >= even_.size()) even_.resize(zone.number() + 1);
  }
  edge_cost_.assign(t.graph.edge_count(), 0.0);
  for (const EdgeIndex e : edge_cost_.indices()) {
    const HalfEdgeIndex h = PlanarGraph::forward(e);
    if (run_cost)
      edge_cost_[e] = run_cost(t.graph.position[t.graph.origin(h)], t.graph.position[t.graph.target(h)]);
  }
  shares_.resize(t.stop_count());
  for (const StopIndex s : shares_.indices()) {
    if (!t.visited(s)) continue;
    shares_[s] = share(s, t.before[s], t.next[s]);
    length_ += shares_[s].length;
    if (shares_[s].bin >= 0) even_[demand_[s].even_zone].length += shares_[s].length;
    add_mass(demand_[s].even_zone, shares_[s].bin, shares_[s].length);
  }
  value_ = recomputed();
  flawed_above_ = -flaw_share * weights_.reward * edge_length_;
  flaw_at_.assign(t.stop_count(), -1);
  for (const StopIndex s : t.free.indices()) {
    if (t.free[s]) update_flaw(s);
  }
}

void CycleObjective::update_flaw(StopIndex s) {
  const bool flawed = shares_[s].cost - weights_.reward * shares_[s].length > flawed_above_;
  if (flawed == (flaw_at_[s] >= 0)) return;
  if (flawed) {
    flaw_at_[s] = static_cast<int>(flaws_.size());
    flaws_.push_back(s);
    return;
  }
  const StopIndex last = flaws_.back();
  flaws_[flaw_at_[s]] = last;
  flaw_at_[last] = flaw_at_[s];
  flaw_at_[s] = -1;
  flaws_.pop_back();
}

CycleObjective::Share CycleObjective::share(StopIndex s, StopIndex before, StopIndex next) const {
  const Tour& t = tour_.tour();
  const Demand& demand = demand_[s];
  const Vec2 chord = t.position[next] - t.position[before];
  const double length2 = chord.squaredNorm(), half = std::sqrt(length2) / 2;
  Share result;
  result.cost = half * weights_.chord * off_direction(chord, length2, demand.direction);
  result.length = half;
  if (demand.even_zone.valid()) {
    const double angle = std::atan2(chord.y(), chord.x()) / pi;
    const int bin = static_cast<int>(std::floor((angle - std::floor(angle)) * bins));
    result.bin = std::clamp(bin, 0, bins - 1);
  }
  return result;
}

double CycleObjective::evenness_of(const EvenZone& zone) const {
  double sum = 0;
  for (std::size_t k = 0; k < bins; ++k) sum += zone.mass[k] * zone.potential[k];
  return zone.length > 0 ? weights_.evenness * sum / zone.length : 0.0;
}

/// −reward · length; near the target length the slope rises from −reward (at 0.9 of it) to +reward (at 1.1).
double CycleObjective::length_cost(double length) const {
  if (!(weights_.length > 0)) return -weights_.reward * length;
  const double x = length / weights_.length;
  double earned = x;
  if (x > 1 + length_band) {
    earned = 2 - x;
  } else if (x > 1 - length_band) {
    earned = 1 - length_band / 2 - (1 - x) * (1 - x) / (2 * length_band);
  }
  return -weights_.reward * weights_.length * earned;
}

double CycleObjective::recomputed() const {
  const Tour& t = tour_.tour();
  double value = 0, length = 0;
  for (const StopIndex s : t.next.indices()) {
    if (!t.visited(s)) continue;
    const Share now = share(s, t.before[s], t.next[s]);
    value += now.cost + edge_cost(t.leave[s]);
    length += now.length;
  }
  value += length_cost(length);
  for (const EvenZone& zone : even_) value += evenness_of(zone);
  return value;
}

void CycleObjective::add_mass(EvenZoneIndex zone, int bin, double weight) {
  if (!zone.valid() || bin < 0) return;
  EvenZone& even = even_[zone];
  even.mass[bin] += weight;
  for (int k = 0; k < bins; ++k) even.potential[k] += weight * kernel_[std::abs(k - bin)];
}

/// The change of all zones' evenness: the moved masses in the old potential, and their effect on one another.
double CycleObjective::evenness_difference() const {
  struct Move {
    EvenZoneIndex zone;
    int bin;
    double weight;
  };
  std::array<Move, 16> moves{};
  std::size_t count = 0;
  for (std::size_t k = 0; k < affected_count_; ++k) {
    const Affected& a = affected_[k];
    const EvenZoneIndex zone = demand_[a.stop].even_zone;
    if (!zone.valid()) continue;
    const Share& old = shares_[a.stop];
    moves[count++] = {zone, old.bin, -old.length};
    moves[count++] = {zone, a.share.bin, a.share.length};
  }
  double sum = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const EvenZone& zone = even_[moves[i].zone];
    if (!(zone.length > 0)) continue;
    double change = 2 * zone.potential[moves[i].bin];
    for (std::size_t j = 0; j < count; ++j) {
      if (moves[j].zone != moves[i].zone) continue;
      change += moves[j].weight * kernel_[std::abs(moves[i].bin - moves[j].bin)];
    }
    sum += weights_.evenness * moves[i].weight * change / zone.length;
  }
  return sum;
}

double CycleObjective::difference(const LocalChange& change) {
  const Tour& t = tour_.tour();
  affected_count_ = 0;
  const auto entry = [&](StopIndex s) -> Affected& {
    for (std::size_t k = 0; k < affected_count_; ++k) {
      if (affected_[k].stop == s) return affected_[k];
    }
    Affected& fresh = affected_[affected_count_++];
    fresh = {s, t.before[s], t.next[s], {}};
    return fresh;
  };
  difference_ = longer_ = 0;
  for (std::size_t k = 0; k < change.count; ++k) {
    const Departure& d = change.departures[k];
    const StopIndex to = tour_.target(d.by);
    entry(d.stop).next = to;
    entry(to).before = d.stop;
    difference_ += edge_cost(d.by) - edge_cost(t.leave[d.stop]);
  }
  for (std::size_t k = 0; k < affected_count_; ++k) {
    Affected& a = affected_[k];
    a.share = share(a.stop, a.before, a.next);
    const Share& old = shares_[a.stop];
    difference_ += a.share.cost - old.cost;
    longer_ += a.share.length - old.length;
  }
  difference_ += length_cost(length_ + longer_) - length_cost(length_);
  if (!even_.empty()) difference_ += evenness_difference();
  return difference_;
}

void CycleObjective::accept() {
  for (std::size_t k = 0; k < affected_count_; ++k) {
    const Affected& a = affected_[k];
    Share& old = shares_[a.stop];
    const EvenZoneIndex zone = demand_[a.stop].even_zone;
    if (old.bin != a.share.bin || old.length != a.share.length) {
      add_mass(zone, old.bin, -old.length);
      add_mass(zone, a.share.bin, a.share.length);
    }
    old = a.share;
    update_flaw(a.stop);
  }
  value_ += difference_;
  length_ += longer_;
}

}  // namespace unicursal::core
