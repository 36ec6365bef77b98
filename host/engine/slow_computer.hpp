// What planning would cost in virtual time: a computer that is some times slower than this one, plans one
// layer after the other with all its threads, and begins a layer when the look-ahead has room for it.
#pragma once

#include <cstddef>
#include <deque>

namespace unicursal::host {

class SlowComputer {
 public:
  /// `factor`: how many times slower; 0: planning takes no time. `ahead`: layers that may be open at once.
  SlowComputer(double factor, std::size_t threads, std::size_t ahead);

  /// The next layer, which has cost this computer so many seconds of its processors, is asked for `now`.
  /// Returns when it is there, not before now. Times in s on any one clock that starts when planning does.
  double ready(double cpu_seconds, double now);

 private:
  double factor_, threads_;
  std::size_t ahead_;
  double done_ = 0;           ///< when the last layer was planned
  std::deque<double> taken_;  ///< when the last layers were taken, at most `ahead_` of them
};

}  // namespace unicursal::host
