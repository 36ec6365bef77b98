#include "sim/motion/feeder_split.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

namespace unicursal::sim {

PerFeeder<std::int64_t> FeederSplit::split(std::int64_t steps, const Factors& factors) {
  const PerFeeder<double> shares = shares_of(factors);
  assert(std::any_of(shares.begin(), shares.end(), [](double s) { return s > 0; }));
  PerFeeder<std::int64_t> given{};
  for (std::size_t i = 0; i < max_feeders; ++i) {
    owed_[i] += static_cast<double>(steps) * shares[i];
    if (shares[i] == 0) continue;
    given[i] = static_cast<std::int64_t>(std::floor(owed_[i]));
    owed_[i] -= static_cast<double>(given[i]);
  }
  // Rounding down leaves a few steps: they go to the feeders of the mixture that are owed the most.
  std::int64_t left = steps - std::accumulate(given.begin(), given.end(), std::int64_t{0});
  for (; left != 0; left -= left > 0 ? 1 : -1) {
    std::size_t chosen = max_feeders;
    for (std::size_t i = 0; i < max_feeders; ++i) {
      if (shares[i] > 0 && (chosen == max_feeders || (owed_[i] > owed_[chosen]) == (left > 0))) chosen = i;
    }
    const int sign = left > 0 ? 1 : -1;
    given[chosen] += sign;
    owed_[chosen] -= sign;
  }
  return given;
}

}  // namespace unicursal::sim
