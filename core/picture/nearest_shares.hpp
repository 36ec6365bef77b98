// The mixture of filaments whose colour comes nearest to a wanted one.
#pragma once

#include <vector>

#include "core/picture/filaments.hpp"
#include "core/picture/lab.hpp"

namespace unicursal::picture {

struct NearestShares {
  std::vector<double> shares;  ///< of the feeders, sum 1
  Light made{};                ///< its colour
  double difference = 0;       ///< from the wanted colour, ΔE2000
};

/// Shares are multiples of 1 / `steps`, and at least `floor`, which is rounded up to such a multiple. From
/// the best places of a coarse grid over every three feeders, steps go from feeder to feeder as long as that
/// helps, first many, then few. Preconditions: 1 ≤ feeders ≤ filaments.size(), 0 ≤ floor ≤ 1 ÷ feeders,
/// feeders ≤ steps.
NearestShares nearest_shares(const Lab& wanted, const Filaments& filaments, std::size_t feeders, double floor,
                             int steps = 100);

}  // namespace unicursal::picture
