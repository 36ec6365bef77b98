#include "sim/firmware/mixer.hpp"

#include <algorithm>
#include <cassert>

namespace unicursal::sim {

Mixer::Mixer(std::size_t feeders) : feeders_(feeders) {
  assert(feeders >= 1 && feeders <= max_feeders);
  for (std::size_t tool = 0; tool < factors_.size(); ++tool) {
    factors_[tool][tool < feeders ? tool : 0] = full_scale;
  }
}

void Mixer::collect(double feeder, double share) {
  if (feeder < 0 || feeder >= static_cast<double>(feeders_)) return;
  collector_[static_cast<std::size_t>(feeder)] = std::max(share, 0.0);
}

void Mixer::store(double tool) {
  if (tool < 0 || tool >= tools) return;
  const double largest = *std::max_element(collector_.begin(), collector_.end());
  Factors& factors = factors_[static_cast<std::size_t>(tool)];
  for (std::size_t i = 0; i < max_feeders; ++i) {
    factors[i] = largest > 0 ? static_cast<std::int32_t>(collector_[i] / largest * full_scale) : 0;
  }
}

bool Mixer::select(double tool) {
  if (tool < 0 || tool >= tools) return false;
  selected_ = static_cast<int>(tool);
  return true;
}

}  // namespace unicursal::sim
