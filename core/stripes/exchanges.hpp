// Exchanges of arcs between loops that run side by side: an arc is taken out of each, and two bridges lead
// across, so that the two become one. The price of an exchange is the alignment that it costs: the squared
// angle to the field along the bridges, less that along the arcs. At the end of a strand within a field, an
// exchange costs next to nothing; between two straight strands it costs two round hairpins. mm, radians.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/stripes/chains.hpp"

namespace unicursal::core {

/// One bridge leads from `leave` to `other_enter`, the other from `other_leave` to `enter`. What lies between
/// `leave` and `enter`, and between `other_leave` and `other_enter`, goes.
struct Exchange {
  std::size_t leave = 0, enter = 0, other_leave = 0, other_enter = 0;  ///< points
  double cost = 0;                                                     ///< rad² · bead widths
};

struct ExchangeOptions {
  double bead_width = 0;   ///< mm
  double reach = 0;        ///< greatest length of a bridge, mm
  std::uint64_t seed = 0;  ///< decides between exchanges of nearly the same price
};

/// The cheapest exchange that leaves each point for another set of loops, at most one for each point, best
/// first. `group[l]` is the set to which loop l belongs; points that are `used` take no part.
std::vector<Exchange> exchanges(const Chains& chains, const DirectionField& field,
                                const std::vector<std::size_t>& group, const std::vector<char>& used,
                                const ExchangeOptions& options);

}  // namespace unicursal::core
