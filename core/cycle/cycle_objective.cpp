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
  const double norm2 = v.squaredNorm();
  if (!(norm2 > 0) || !(length2 > 0)) return 0;
  const double norm = std::sqrt(norm2);
  const double cosine =
      ((u.x() * u.x() - u.y() * u.y()) * v.x() + 2 * u.x() * u.y() * v.y()) / (length2 * norm);
  return norm * squared_angle(std::clamp((1 - cosine) / 2, 0.0, 1.0));
}

/// The angle of a line as a share of half a turn, 0 to 1, within 4·10⁻⁶. Faster than std::atan2.
double share_of_half_turn(const Vec2& v) {
  const double x = std::abs(v.x()), y = std::abs(v.y());
  const double high = std::max(x, y);
  if (!(high > 0)) return 0;
  const double t = std::min(x, y) / high, t2 = t * t;
  // A polynomial for the arc tangent (Abramowitz, Stegun, 4.4.49).
  double angle =
      t * (0.9998660 + t2 * (-0.3302995 + t2 * (0.1801410 + t2 * (-0.0851330 + t2 * 0.0208351)))) / pi;
  if (y > x) angle = 0.5 - angle;
  return (v.x() < 0) == (v.y() < 0) ? angle : 1 - angle;
}

}  // namespace

CycleObjective::CycleObjective(const EditableTour& tour, const DemandAt& demand, const RunCost& run_cost,
                               const ObjectiveWeights& weights)
    : tour_(tour), weights_(weights) {
  const Tour& t = tour.tour();
  for (std::size_t bin = 0; bin < waves_of_.size(); ++bin) {
    for (std::size_t k = 1; k <= waves; ++k) {
      const double angle = 2 * pi * static_cast<double>(k) * (static_cast<double>(bin) + 0.5) / bins;
      const double scale = 1 / (std::numbers::sqrt2 * static_cast<double>(k));
      waves_of_[bin][2 * k - 2] = scale * std::cos(angle);
      waves_of_[bin][2 * k - 1] = scale * std::sin(angle);
    }
  }
  for (const StopIndex s : t.next.indices()) {
    if (t.visited(s)) edge_length_ += (t.position[t.next[s]] - t.position[s]).norm();
  }
  stops_ = std::max<std::size_t>(t.visited_count(), 1);
  edge_length_ /= static_cast<double>(stops_);
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
    if (shares_[s].bin < 0) continue;
    EvenZone& zone = even_[demand_[s].even_zone];
    zone.length += shares_[s].length;
    add_direction(zone.moments, shares_[s].bin, shares_[s].length);
  }
  flawed_above_ = -flaw_share * weights_.reward * edge_length_;
  flaw_at_.assign(t.stop_count(), -1);
}

void CycleObjective::add_direction(Waves& moments, int bin, double length) const {
  const Waves& direction = waves_of_[static_cast<std::size_t>(bin)];
  for (std::size_t k = 0; k < moments.size(); ++k) moments[k] += length * direction[k];
}

CycleObjective::Share CycleObjective::share(StopIndex s, StopIndex before, StopIndex next) const {
  const Tour& t = tour_.tour();
  const Demand& demand = demand_[s];
  const Vec2 chord = t.position[next] - t.position[before];
  const double length2 = chord.squaredNorm(), half = std::sqrt(length2) / 2;
  Share result;
  result.cost = half * weights_.chord * off_direction(chord, length2, demand.direction);
  result.length = half;
  if (demand.even_zone.valid())
    result.bin = std::clamp(static_cast<int>(share_of_half_turn(chord) * bins), 0, bins - 1);
  return result;
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

double CycleObjective::value() const {
  const Tour& t = tour_.tour();
  double value = 0, length = 0;
  Per<EvenZoneIndex, Waves> moments(even_.size(), Waves{});
  for (const StopIndex s : t.next.indices()) {
    if (!t.visited(s)) continue;
    const Share now = share(s, t.before[s], t.next[s]);
    value += now.cost + edge_cost(t.leave[s]);
    length += now.length;
    if (now.bin >= 0) add_direction(moments[demand_[s].even_zone], now.bin, now.length);
  }
  value += length_cost(length);
  for (const EvenZoneIndex z : even_.indices()) {
    double sum = 0;
    for (const double m : moments[z]) sum += m * m;
    if (even_[z].length > 0) value += weights_.evenness * sum / even_[z].length;
  }
  return value;
}

void CycleObjective::join(const std::vector<WindowObjective>& windows) {
  for (const WindowObjective& window : windows) {
    length_ += window.longer_;
    for (const EvenZoneIndex z : even_.indices()) {
      for (std::size_t k = 0; k < even_[z].moments.size(); ++k) even_[z].moments[k] += window.gained_[z][k];
    }
  }
}

WindowObjective::WindowObjective(CycleObjective& whole, const TourWindow& window)
    : whole_(&whole),
      like_this_(static_cast<double>(whole.stops_) /
                 static_cast<double>(std::max<std::size_t>(window.sequence.size(), 1))),
      gained_(whole.even_.size(), Waves{}) {
  for (const StopIndex s : window.movable) {
    whole_->flaw_at_[s] = -1;
    update_flaw(s);
  }
}

void WindowObjective::update_flaw(StopIndex s) {
  const Share& share = whole_->shares_[s];
  int& at = whole_->flaw_at_[s];
  const bool flawed = share.cost - whole_->weights_.reward * share.length > whole_->flawed_above_;
  if (flawed == (at >= 0)) return;
  if (flawed) {
    at = static_cast<int>(flaws_.size());
    flaws_.push_back(s);
    return;
  }
  const StopIndex last = flaws_.back();
  flaws_[static_cast<std::size_t>(at)] = last;
  whole_->flaw_at_[last] = at;
  at = -1;
  flaws_.pop_back();
}

CycleObjective::Waves& WindowObjective::turned_in(EvenZoneIndex zone) {
  for (std::size_t k = 0; k < turned_count_; ++k) {
    if (turned_[k].zone == zone) return turned_[k].by;
  }
  Turned& fresh = turned_[turned_count_++];
  fresh = {zone, {}};
  return fresh.by;
}

double WindowObjective::evenness_difference() {
  for (std::size_t k = 0; k < affected_count_; ++k) {
    const Affected& a = affected_[k];
    const Share& old = whole_->shares_[a.stop];
    if (a.share.bin < 0 || (a.share.bin == old.bin && a.share.length == old.length)) continue;
    Waves& by = turned_in(whole_->demand_[a.stop].even_zone);
    whole_->add_direction(by, old.bin, -old.length);
    whole_->add_direction(by, a.share.bin, a.share.length);
  }
  double sum = 0;
  for (std::size_t k = 0; k < turned_count_; ++k) {
    const CycleObjective::EvenZone& zone = whole_->even_[turned_[k].zone];
    if (!(zone.length > 0)) continue;
    const Waves &by = turned_[k].by, &gained = gained_[turned_[k].zone];
    double change = 0;
    for (std::size_t i = 0; i < by.size(); ++i)
      change += by[i] * (2 * (zone.moments[i] + like_this_ * gained[i]) + like_this_ * by[i]);
    sum += whole_->weights_.evenness * change / zone.length;
  }
  return sum;
}

/// Collects the stops that get new neighbours.
void WindowObjective::note(const LocalChange& change) {
  const Tour& t = whole_->tour_.tour();
  const auto entry = [&](StopIndex s) -> Affected& {
    for (std::size_t k = 0; k < affected_count_; ++k) {
      if (affected_[k].stop == s) return affected_[k];
    }
    Affected& fresh = affected_[affected_count_++];
    fresh = {s, t.before[s], t.next[s], {}};
    return fresh;
  };
  affected_count_ = 0;
  for (std::size_t k = 0; k < change.count; ++k) {
    const Departure& d = change.departures[k];
    const StopIndex to = whole_->tour_.target(d.by);
    entry(d.stop).next = to;
    entry(to).before = d.stop;
  }
}

double WindowObjective::difference(const LocalChange& change) {
  const Tour& t = whole_->tour_.tour();
  note(change);
  double rise = 0;
  stretched_ = 0;
  turned_count_ = 0;
  for (std::size_t k = 0; k < change.count; ++k) {
    const Departure& d = change.departures[k];
    rise += whole_->edge_cost(d.by) - whole_->edge_cost(t.leave[d.stop]);
  }
  for (std::size_t k = 0; k < affected_count_; ++k) {
    Affected& a = affected_[k];
    a.share = whole_->share(a.stop, a.before, a.next);
    const Share& old = whole_->shares_[a.stop];
    rise += a.share.cost - old.cost;
    stretched_ += a.share.length - old.length;
  }
  const double length = whole_->length_ + like_this_ * longer_;
  rise += whole_->length_cost(length + stretched_) - whole_->length_cost(length);
  if (!whole_->even_.empty()) rise += evenness_difference();
  return rise;
}

void WindowObjective::accept() {
  for (std::size_t k = 0; k < affected_count_; ++k) {
    whole_->shares_[affected_[k].stop] = affected_[k].share;
    update_flaw(affected_[k].stop);
  }
  for (std::size_t k = 0; k < turned_count_; ++k) {
    Waves& gained = gained_[turned_[k].zone];
    for (std::size_t i = 0; i < gained.size(); ++i) gained[i] += turned_[k].by[i];
  }
  longer_ += stretched_;
}

}  // namespace unicursal::core
