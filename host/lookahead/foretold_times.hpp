// Estimates how long layers will print that have not been planned yet. A thread of its own slices all of them
// and adds up area × height ÷ flow, which takes about a millisecond per layer.
//
//   ForetoldTimes times(*part, first, count, flow);
//   if (const auto seconds = times.between(20, count)) show(*seconds);
#pragma once

#include <atomic>
#include <cstddef>
#include <optional>
#include <thread>
#include <vector>

#include "core/model/part.hpp"

namespace unicursal::host {

/// The time that a layer prints at `flow` mm³/s, s; 0 if the flow is 0 (unknown).
double foretold_seconds(const core::Layer& layer, double flow);

class ForetoldTimes {
 public:
  /// Starts to slice `count` layers from `first` on. `part` must outlive this object.
  ForetoldTimes(const core::Part& part, std::size_t first, std::size_t count, double flow);

  /// Time of the layers from `begin` up to but without `end`, s. Layers are counted from `first`; layers that
  /// do not exist take no time. Returns nullopt until all times are known, and forever if a layer cannot be
  /// sliced (planning then reports the reason). May be called from any thread.
  std::optional<double> between(std::size_t begin, std::size_t end) const;

 private:
  std::vector<double> behind_;  ///< per layer: time of it and of all later layers, s
  std::atomic<bool> known_ = false;
  std::jthread thread_;  ///< the last member, so that it ends before the members that it fills
};

}  // namespace unicursal::host
