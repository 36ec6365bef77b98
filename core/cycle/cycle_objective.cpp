#include "core/cycle/cycle_objective.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace unicursal::core {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double length_band = 0.1;  ///< of the asked length, to either side
constexpr double flaw_share = 0.6;   ///< of what a full chord earns; a stop that earns less is a flaw

/// off² from sin² off, within 2 %: the start of the series of arcsin², and what makes it end at π²/4.
double squared_angle(double sine2) {
  const double u = sine2, u2 = u * u, u4 = u2 * u2;
  return u + u2 / 3 + 0.143 * u2 * u + 0.991 * u4 * u4;
}

/// ‖V‖ times the squared angle between a line along `u` (of squared length `length2`) and the direction of V.
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
    // Σ_k cos(2kθ) ÷ 2k²
    const double angle = pi * k / bins;
    kernel_[static_cast<std::size_t>(k)] = (pi * pi / 6 - pi * angle + angle * angle) / 2;
  }
  std::size_t visited = 0;
  for (std::size_t s = 0; s < t.stop_count(); ++s) {
    if (t.next[s] < 0) continue;
    edge_length_ += (t.position[static_cast<std::size_t>(t.next[s])] - t.position[s]).norm();
    ++visited;
  }
  edge_length_ /= static_cast<double>(std::max<std::size_t>(visited, 1));
  demand_.resize(t.stop_count());
  for (std::size_t s = 0; s < t.stop_count(); ++s) {
    if (demand) demand_[s] = demand(t.position[s]);
    if (demand_[s].even_zone >= static_cast<int>(even_.size()))
      even_.resize(static_cast<std::size_t>(demand_[s].even_zone) + 1);
  }
  edge_cost_.assign(t.graph.edge_count(), 0.0);
  for (std::size_t e = 0; e < edge_cost_.size(); ++e) {
    const auto h = static_cast<HalfEdgeIndex>(2 * e);
    const Vec2 a = t.graph.position[static_cast<std::size_t>(t.graph.origin(h))],
               b = t.graph.position[static_cast<std::size_t>(t.graph.target(h))];
    if (run_cost) edge_cost_[e] = run_cost(a, b);
  }
  pieces_.resize(t.stop_count());
  for (std::size_t s = 0; s < t.stop_count(); ++s) {
    if (t.next[s] < 0) continue;
    pieces_[s] = piece(static_cast<StopIndex>(s), t.before[s], t.next[s]);
    length_ += pieces_[s].length;
    if (pieces_[s].bin >= 0)
      even_[static_cast<std::size_t>(demand_[s].even_zone)].length += pieces_[s].length;
    add_mass(demand_[s].even_zone, pieces_[s].bin, pieces_[s].length);
  }
  value_ = recomputed();
  flawed_above_ = -flaw_share * weights_.reward * edge_length_;
  flaw_at_.assign(t.stop_count(), -1);
  for (std::size_t s = 0; s < t.stop_count(); ++s) {
    if (t.free[s]) update_flaw(static_cast<StopIndex>(s));
  }
}

void CycleObjective::update_flaw(StopIndex s) {
  const auto i = static_cast<std::size_t>(s);
  const bool flawed = pieces_[i].cost - weights_.reward * pieces_[i].length > flawed_above_;
  if (flawed == (flaw_at_[i] >= 0)) return;
  if (flawed) {
    flaw_at_[i] = static_cast<int>(flaws_.size());
    flaws_.push_back(s);
    return;
  }
  const StopIndex last = flaws_.back();
  flaws_[static_cast<std::size_t>(flaw_at_[i])] = last;
  flaw_at_[static_cast<std::size_t>(last)] = flaw_at_[i];
  flaw_at_[i] = -1;
  flaws_.pop_back();
}

CycleObjective::Piece CycleObjective::piece(StopIndex s, StopIndex before, StopIndex next) const {
  const Tour& t = tour_.tour();
  const Demand& demand = demand_[static_cast<std::size_t>(s)];
  const Vec2 chord =
      t.position[static_cast<std::size_t>(next)] - t.position[static_cast<std::size_t>(before)];
  const double length2 = chord.squaredNorm(), half = std::sqrt(length2) / 2;
  Piece result;
  result.cost = half * weights_.chord * off_direction(chord, length2, demand.direction);
  result.length = half;
  if (demand.even_zone >= 0) {
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

/// −reward · length, with a slope that goes from −reward at 0.9 of the asked length to +reward at 1.1.
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
  for (std::size_t s = 0; s < t.stop_count(); ++s) {
    if (t.next[s] < 0) continue;
    const Piece now = piece(static_cast<StopIndex>(s), t.before[s], t.next[s]);
    value += now.cost + edge_cost(t.leave[s]);
    length += now.length;
  }
  value += length_cost(length);
  for (const EvenZone& zone : even_) value += evenness_of(zone);
  return value;
}

void CycleObjective::add_mass(int zone, int bin, double weight) {
  if (zone < 0 || bin < 0) return;
  EvenZone& even = even_[static_cast<std::size_t>(zone)];
  even.mass[static_cast<std::size_t>(bin)] += weight;
  for (int k = 0; k < bins; ++k) {
    even.potential[static_cast<std::size_t>(k)] +=
        weight * kernel_[static_cast<std::size_t>(std::abs(k - bin))];
  }
}

/// First order in the masses that change, and their effect on each other.
double CycleObjective::evenness_difference() const {
  struct Move {
    int zone, bin;
    double weight;
  };
  std::array<Move, 16> moves{};
  std::size_t count = 0;
  for (int k = 0; k < affected_count_; ++k) {
    const Affected& a = affected_[static_cast<std::size_t>(k)];
    const int zone = demand_[static_cast<std::size_t>(a.stop)].even_zone;
    if (zone < 0) continue;
    const Piece& old = pieces_[static_cast<std::size_t>(a.stop)];
    moves[count++] = {zone, old.bin, -old.length};
    moves[count++] = {zone, a.piece.bin, a.piece.length};
  }
  double sum = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const EvenZone& zone = even_[static_cast<std::size_t>(moves[i].zone)];
    if (!(zone.length > 0)) continue;
    double change = 2 * zone.potential[static_cast<std::size_t>(moves[i].bin)];
    for (std::size_t j = 0; j < count; ++j) {
      if (moves[j].zone != moves[i].zone) continue;
      change += moves[j].weight * kernel_[static_cast<std::size_t>(std::abs(moves[i].bin - moves[j].bin))];
    }
    sum += weights_.evenness * moves[i].weight * change / zone.length;
  }
  return sum;
}

double CycleObjective::difference(const LocalChange& change) {
  const Tour& t = tour_.tour();
  affected_count_ = 0;
  const auto entry = [&](StopIndex s) -> Affected& {
    for (int k = 0; k < affected_count_; ++k) {
      if (affected_[static_cast<std::size_t>(k)].stop == s) return affected_[static_cast<std::size_t>(k)];
    }
    Affected& fresh = affected_[static_cast<std::size_t>(affected_count_++)];
    fresh = {s, t.before[static_cast<std::size_t>(s)], t.next[static_cast<std::size_t>(s)], {}};
    return fresh;
  };
  difference_ = longer_ = 0;
  for (int k = 0; k < change.count; ++k) {
    const Departure& d = change.departures[static_cast<std::size_t>(k)];
    const StopIndex to = tour_.target(d.by);
    entry(d.stop).next = to;
    entry(to).before = d.stop;
    difference_ += edge_cost(d.by) - edge_cost(t.leave[static_cast<std::size_t>(d.stop)]);
  }
  for (int k = 0; k < affected_count_; ++k) {
    Affected& a = affected_[static_cast<std::size_t>(k)];
    a.piece = piece(a.stop, a.before, a.next);
    const Piece& old = pieces_[static_cast<std::size_t>(a.stop)];
    difference_ += a.piece.cost - old.cost;
    longer_ += a.piece.length - old.length;
  }
  difference_ += length_cost(length_ + longer_) - length_cost(length_);
  if (!even_.empty()) difference_ += evenness_difference();
  return difference_;
}

void CycleObjective::accept() {
  for (int k = 0; k < affected_count_; ++k) {
    const Affected& a = affected_[static_cast<std::size_t>(k)];
    Piece& old = pieces_[static_cast<std::size_t>(a.stop)];
    const int zone = demand_[static_cast<std::size_t>(a.stop)].even_zone;
    if (old.bin != a.piece.bin || old.length != a.piece.length) {
      add_mass(zone, old.bin, -old.length);
      add_mass(zone, a.piece.bin, a.piece.length);
    }
    old = a.piece;
    update_flaw(a.stop);
  }
  value_ += difference_;
  length_ += longer_;
}

}  // namespace unicursal::core
