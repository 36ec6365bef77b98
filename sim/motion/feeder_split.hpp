// Distributes the steps of E over the feeders. Every step goes to exactly one feeder, so the counts add up to
// the steps of E. The difference from each feeder's exact share is carried to the next move: after any number
// of steps no feeder is more than two steps from its share (sim/README.md, "Mixing in Marlin").
#pragma once

#include <cstdint>

#include "sim/motion/move.hpp"

namespace unicursal::sim {

class FeederSplit {
 public:
  /// `steps` is negative for a retraction, which is split in the same way. Precondition: not all factors are
  /// zero.
  PerFeeder<std::int64_t> split(std::int64_t steps, const Factors& factors);

 private:
  PerFeeder<double> owed_{};  ///< Exact share − steps given, for each feeder; they add up to 0.
};

}  // namespace unicursal::sim
