#include "firmware_gcode/mixing/chamber.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace unicursal::gcode {
namespace {

constexpr double arrived = 0.95;  ///< of a change, at the end of the mixing volume

/// What has passed n tanks in a row when x tank volumes have.
double passed(std::size_t tanks, double x) {
  double term = std::exp(-x), rest = 0;
  for (std::size_t k = 0; k < tanks; ++k) {
    rest += term;
    term *= x / static_cast<double>(k + 1);
  }
  return 1 - rest;
}

/// The number of tank volumes after which `share` has passed.
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
    : count_(model.mixing_volume > 0 ? model.tanks : 0), tank_volume_(model.tank_volume()) {
  assert(model.tanks <= max_tanks);
  tanks_.fill(shares);
}

// With x = volume ÷ tank volume, the deviation of tank k from the inflow becomes e^−x·Σ_{j≤k} x^(k−j)/(k−j)!
// times those of the tanks j before; what flows out is what the books are short of.
Tanks::Shares Tanks::pass(const Shares& inflow, double volume) {
  Shares out = inflow;
  if (count_ == 0) return out;
  const double x = volume / tank_volume_;
  std::array<double, max_tanks> weights;
  weights[0] = std::exp(-x);
  for (std::size_t k = 1; k < count_; ++k) weights[k] = weights[k - 1] * x / static_cast<double>(k);
  for (std::size_t f = 0; f < max_feeders; ++f) {
    double released = 0;
    for (std::size_t k = count_; k-- > 0;) {
      double deviation = 0;
      for (std::size_t j = 0; j <= k; ++j) deviation += weights[k - j] * (tanks_[j][f] - inflow[f]);
      released += tanks_[k][f] - (inflow[f] + deviation);
      tanks_[k][f] = inflow[f] + deviation;
    }
    out[f] = inflow[f] + released / x;
  }
  return out;
}

double Tanks::difference(const Tanks& other) const {
  double greatest = 0;
  for (std::size_t k = 0; k < count_; ++k) {
    for (std::size_t f = 0; f < max_feeders; ++f) {
      greatest = std::max(greatest, std::abs(tanks_[k][f] - other.tanks_[k][f]));
    }
  }
  return greatest;
}

double Tanks::difference(const Shares& shares) const {
  double greatest = 0;
  for (std::size_t k = 0; k < count_; ++k) {
    for (std::size_t f = 0; f < max_feeders; ++f) {
      greatest = std::max(greatest, std::abs(tanks_[k][f] - shares[f]));
    }
  }
  return greatest;
}

}  // namespace unicursal::gcode
