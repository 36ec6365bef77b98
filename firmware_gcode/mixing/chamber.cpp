#include "firmware_gcode/mixing/chamber.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace unicursal::gcode {
namespace {

constexpr double arrived = 0.95;  ///< fraction of a change at the end of the mixing volume

/// The step response of n tanks in series after x tank volumes.
double passed(std::size_t tanks, double x) {
  double term = std::exp(-x), rest = 0;
  for (std::size_t k = 0; k < tanks; ++k) {
    rest += term;
    term *= x / static_cast<double>(k + 1);
  }
  return 1 - rest;
}

/// The inverse: the number of tank volumes after which `share` has arrived.
double tank_volumes_for(std::size_t tanks, double share) {
  double low = 0, high = 1;
  while (passed(tanks, high) < share) high *= 2;
  for (int halving = 0; halving < 60; ++halving) {
    const double middle = (low + high) / 2;
    (passed(tanks, middle) < share ? low : high) = middle;
  }
  return (low + high) / 2;
}

}  // namespace

double ChamberModel::tank_volume() const {
  return mixing_volume > 0 ? mixing_volume / tank_volumes_for(tanks, arrived) : 0;
}

double ChamberModel::step_response(double volume) const {
  if (volume < dead_volume) return 0;
  const double tank = tank_volume();
  return tank > 0 ? passed(tanks, (volume - dead_volume) / tank) : 1;
}

double ChamberModel::delay(double share) const {
  assert(share >= 0 && share < 1);
  const double tank = tank_volume();
  return dead_volume + (tank > 0 && share > 0 ? tank * tank_volumes_for(tanks, share) : 0);
}

double ChamberModel::mean_delay() const {
  return dead_volume + static_cast<double>(tanks) * tank_volume();
}

Tanks::Tanks(const ChamberModel& model, const Shares& shares)
    : count_(model.mixing_volume > 0 ? model.tanks : 0),
      feeders_(shares.size()),
      tank_volume_(model.tank_volume()) {
  assert(model.tanks <= max_tanks);
  for (std::size_t k = 0; k < count_; ++k)
    std::copy(shares.begin(), shares.end(), shares_.begin() + static_cast<std::ptrdiff_t>(k * feeders_));
}

Tanks& Tanks::operator=(const Tanks& other) {
  count_ = other.count_;
  feeders_ = other.feeders_;
  tank_volume_ = other.tank_volume_;
  std::copy_n(other.shares_.begin(), count_ * feeders_, shares_.begin());
  return *this;
}

// With x = volume ÷ tank volume, the deviation of tank k from the inflow becomes e^−x·Σ_{j≤k} x^(k−j)/(k−j)!
// times the former deviation of tank j. The outflow follows from the balance of volumes.
Shares Tanks::pass(const Shares& inflow, double volume) {
  assert(inflow.size() == feeders_);
  Shares out = inflow;
  if (count_ == 0) return out;
  const double x = volume / tank_volume_;
  std::array<double, max_tanks> weights;
  weights[0] = std::exp(-x);
  for (std::size_t k = 1; k < count_; ++k) weights[k] = weights[k - 1] * x / static_cast<double>(k);
  for_each_feeder(feeders_, [&](std::size_t f) {
    double released = 0;
    for (std::size_t k = count_; k-- > 0;) {
      double deviation = 0;
      for (std::size_t j = 0; j <= k; ++j) deviation += weights[k - j] * (share(j, f) - inflow[f]);
      released += share(k, f) - (inflow[f] + deviation);
      share(k, f) = inflow[f] + deviation;
    }
    out[f] = inflow[f] + released / x;
  });
  return out;
}

bool Tanks::is_like(const Tanks& other, double least) const {
  for (std::size_t i = 0; i < count_ * feeders_; ++i) {
    if (std::abs(shares_[i] - other.shares_[i]) >= least) return false;
  }
  return true;
}

}  // namespace unicursal::gcode
