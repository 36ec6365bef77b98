// Which feeder takes each step of E. Every step goes to exactly one feeder, so that the counts add up to the
// steps of E, and the error against the exact share of each feeder is carried to the next move: after any
// number of steps no feeder is more than two steps from its share. (Firmware facts: 0.5/0.5/0 over 5000
// steps gives 2500/2500/0.)
#pragma once

#include <cstdint>

#include "sim/motion/move.hpp"

namespace unicursal::sim {

class FeederSplit {
 public:
  /// `steps` is negative for a retraction, which is split alike. Precondition: not all factors are zero.
  PerFeeder<std::int64_t> split(std::int64_t steps, const Factors& factors);

 private:
  PerFeeder<double> owed_{};  ///< steps that a feeder should have had and has not; they add up to 0
};

}  // namespace unicursal::sim
