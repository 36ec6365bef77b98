#include "sim/motion/move.hpp"

#include <numeric>

namespace unicursal::sim {

PerFeeder<double> shares_of(const Factors& factors) {
  PerFeeder<double> shares{};
  const auto sum = std::accumulate(factors.begin(), factors.end(), std::int64_t{0});
  if (sum == 0) return shares;
  for (std::size_t i = 0; i < max_feeders; ++i) {
    shares[i] = static_cast<double>(factors[i]) / static_cast<double>(sum);
  }
  return shares;
}

bool lays_bead(const ExecutedMove& move) {
  return move.filament > 0 && (move.from.x != move.to.x || move.from.y != move.to.y);
}

}  // namespace unicursal::sim
