// How long layers will print that nobody has planned yet: a thread of its own slices them all and adds up
// area × height ÷ flow, which takes about a millisecond a layer.
//
//   ForetoldTimes times(*part, first, count, flow);
//   if (const auto seconds = times.between(20, count)) tell(*seconds);
#pragma once

#include <atomic>
#include <cstddef>
#include <optional>
#include <thread>
#include <vector>

#include "core/model/part.hpp"

namespace unicursal::host {

/// s that a layer takes at `flow`, mm³/s; 0 where that is unknown.
double foretold_seconds(const core::Layer& layer, double flow);

class ForetoldTimes {
 public:
  /// Of `count` layers from `first` on. `part` must outlive this object.
  ForetoldTimes(const core::Part& part, std::size_t first, std::size_t count, double flow);

  /// s of the layers from `begin` up to `end`, which is not one of them, counted from the first; those that
  /// are not there take no time. Nothing until all are known, nor when one could not be sliced: planning
  /// tells why. From any thread.
  std::optional<double> between(std::size_t begin, std::size_t end) const;

 private:
  std::vector<double> behind_;  ///< s of the layer and all after it
  std::atomic<bool> known_ = false;
  std::jthread thread_;  ///< last, so that it ends before what it fills
};

}  // namespace unicursal::host
