#include "sim/firmware/mixer.hpp"

#include <algorithm>
#include <cassert>

namespace unicursal::sim {

Mixer::Mixer(std::size_t feeders, std::int32_t full_scale, int tools)
    : feeders_(feeders), full_scale_(full_scale), tools_(tools) {
  assert(feeders >= 1 && feeders <= max_feeders);
  for (std::size_t tool = 0; tool < factors_.size(); ++tool) {
    factors_[tool][tool < feeders ? tool : 0] = full_scale;
  }
}

void Mixer::collect(double feeder, double share) {
  if (feeder < 0 || feeder >= static_cast<double>(feeders_)) return;
  collector_[static_cast<std::size_t>(feeder)] = std::max(share, 0.0);
}

/// Truncates fractions, as the firmware's conversion to integers does.
Factors Mixer::factors_for(const PerFeeder<double>& shares) const {
  const double largest = *std::max_element(shares.begin(), shares.end());
  Factors factors{};
  for (std::size_t i = 0; i < feeders_ && largest > 0; ++i) {
    factors[i] = static_cast<std::int32_t>(std::max(shares[i], 0.0) / largest * full_scale_);
  }
  return factors;
}

void Mixer::store(double tool) {
  if (tool < 0 || tool >= tools_) return;
  factors_[static_cast<std::size_t>(tool)] = factors_for(collector_);
}

bool Mixer::select(double tool) {
  if (tool < 0 || tool >= tools_) return false;
  selected_ = static_cast<int>(tool);
  return true;
}

}  // namespace unicursal::sim
