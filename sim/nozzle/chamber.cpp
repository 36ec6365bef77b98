#include "sim/nozzle/chamber.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

namespace unicursal::sim {

namespace {

constexpr double arrived = 0.95;     // share of a new mixture at the end of the mixing volume
constexpr double piece = 0.125;      // longest piece of an outflow, in tank volumes
constexpr int most_pieces = 64;      // pieces of one feed
constexpr double same_share = 1e-9;  // slugs that differ by less are merged

/// Share of the new mixture behind n tanks in series after x tank volumes: 1 − e^−x·Σ_{j<n} x^j/j!
double gamma_response(std::size_t tanks, double x) {
  double term = std::exp(-x), rest = 0;
  for (std::size_t j = 0; j < tanks; ++j) {
    rest += term;
    term *= x / static_cast<double>(j + 1);
  }
  return 1 - rest;
}

double quantile(std::size_t tanks, double response) {
  double low = 0, high = 10.0 * static_cast<double>(tanks);
  while (high - low > 1e-12) {
    const double middle = (low + high) / 2;
    if (middle == low || middle == high) break;
    (gamma_response(tanks, middle) < response ? low : high) = middle;
  }
  return (low + high) / 2;
}

double sum(const PerFeeder<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

bool alike(const PerFeeder<double>& a, const PerFeeder<double>& b) {
  for (std::size_t f = 0; f < max_feeders; ++f) {
    if (std::abs(a[f] - b[f]) > same_share) return false;
  }
  return true;
}

}  // namespace

double Outflow::total() const {
  return sum(volume);
}

double tank_volume(const ChamberSize& size) {
  if (size.mixing_volume <= 0 || size.tanks == 0) return 0;
  return size.mixing_volume / quantile(size.tanks, arrived);
}

double step_response(const ChamberSize& size, double volume) {
  if (volume < size.dead_volume) return 0;
  const double tank = tank_volume(size);
  return tank > 0 ? gamma_response(size.tanks, (volume - size.dead_volume) / tank) : 1;
}

Chamber::Chamber(const ChamberSize& size, std::size_t feeders)
    : size_(size), tank_volume_(tank_volume(size)), feeders_(feeders) {
  assert(feeders >= 1 && feeders <= max_feeders && size.dead_volume >= 0);
  Shares equal{};
  for (std::size_t f = 0; f < feeders; ++f) equal[f] = 1 / static_cast<double>(feeders);
  if (size.dead_volume > 0) pipe_.push_back({size.dead_volume, equal});
  if (tank_volume_ > 0) tanks_.assign(size.tanks, equal);
}

/// Divides the feed at the moments at which an inlet's void is full: in between, the mixture is constant.
std::vector<Outflow> Chamber::feed(const Shares& volume) {
  std::vector<Outflow> out;
  std::vector<double> moments{0, 1};
  Shares begins{};
  for (std::size_t f = 0; f < feeders_; ++f) {
    if (volume[f] > 0) {
      begins[f] = std::min(1.0, voids_[f] / volume[f]);
      moments.push_back(begins[f]);
    }
    voids_[f] = std::max(0.0, voids_[f] - volume[f]);
  }
  std::sort(moments.begin(), moments.end());
  for (std::size_t i = 0; i + 1 < moments.size(); ++i) {
    const double time = moments[i + 1] - moments[i];
    if (time <= 0) continue;
    Shares inflow{};
    for (std::size_t f = 0; f < feeders_; ++f) {
      if (volume[f] > 0 && begins[f] <= moments[i]) inflow[f] = volume[f] * time;
    }
    if (sum(inflow) > 0) push(inflow, moments[i], moments[i + 1], out);
  }
  return out;
}

void Chamber::push(const Shares& inflow, double from, double to, std::vector<Outflow>& out) {
  const double total = sum(inflow);
  Shares shares{};
  for (std::size_t f = 0; f < feeders_; ++f) shares[f] = inflow[f] / total;
  append(shares, total);
  const double finest = total / most_pieces;
  for (double left = total; left > 0;) {
    Slug& slug = pipe_.front();
    double taken = std::min(left, slug.volume);
    if (!settled(slug.shares)) {
      taken = std::min(taken, std::max(finest, piece * tank_volume_));
    }
    const Shares leaving = through_tanks(slug.shares, taken);
    Outflow flow{to - (to - from) * left / total, 0, leaving};
    left -= taken;
    flow.to = to - (to - from) * left / total;
    out.push_back(flow);
    slug.volume -= taken;
    if (slug.volume <= 0) pipe_.pop_front();
  }
}

bool Chamber::settled(const Shares& shares) const {
  return std::all_of(tanks_.begin(), tanks_.end(), [&](const Shares& tank) { return alike(tank, shares); });
}

void Chamber::append(const Shares& shares, double volume) {
  if (!pipe_.empty() && alike(pipe_.back().shares, shares))
    pipe_.back().volume += volume;
  else
    pipe_.push_back({volume, shares});
}

/// Exact for an inflow of constant shares: with x = volume ÷ tank volume, the deviation of tank k from the
/// inflow becomes Σ_{j≤k} e^−x·x^(k−j)/(k−j)! · (deviation of tank j before). The outflow follows from the
/// balance of volumes.
PerFeeder<double> Chamber::through_tanks(const Shares& shares, double volume) {
  Shares leaving{};
  const double x = tank_volume_ > 0 ? volume / tank_volume_ : 0;
  const double decay = std::exp(-x);
  for (std::size_t f = 0; f < feeders_; ++f) {
    leaving[f] = shares[f] * volume;
    for (std::size_t k = tanks_.size(); k-- > 0;) {
      double deviation = 0, weight = decay;
      for (std::size_t j = k + 1; j-- > 0;) {
        deviation += weight * (tanks_[j][f] - shares[f]);
        weight *= x / static_cast<double>(k - j + 1);
      }
      const double now = shares[f] + deviation;
      leaving[f] += tank_volume_ * (tanks_[k][f] - now);
      tanks_[k][f] = now;
    }
    leaving[f] = std::max(0.0, leaving[f]);
  }
  return leaving;
}

PerFeeder<double> Chamber::content() const {
  Shares content{};
  for (std::size_t f = 0; f < feeders_; ++f) {
    for (const Slug& slug : pipe_) content[f] += slug.volume * slug.shares[f];
    for (const Shares& tank : tanks_) content[f] += tank_volume_ * tank[f];
    content[f] -= voids_[f];
  }
  return content;
}

}  // namespace unicursal::sim
