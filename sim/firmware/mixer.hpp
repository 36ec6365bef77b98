// Virtual tools of Marlin 2.1's mixing extruder (sim/README.md, "Mixing in Marlin"): M163 fills a collector
// that persists; M164 copies it into a tool as integers relative to the largest share.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "sim/motion/move.hpp"

namespace unicursal::sim {

class Mixer {
 public:
  static constexpr int most_tools = 16;

  /// `full_scale` is the factor of the largest share: 32768 on 32-bit boards, 128 on 8-bit boards. The first
  /// tools are the pure feeders; all others are feeder 1. Precondition: 1 ≤ feeders ≤ max_feeders.
  /// `tools`: MIXING_VIRTUAL_TOOLS, 1 to `most_tools`.
  Mixer(std::size_t feeders, std::int32_t full_scale, int tools = most_tools);

  /// M163. A negative share counts as zero; a feeder that does not exist is ignored.
  void collect(double feeder, double share);
  /// M164. A tool that does not exist is ignored.
  void store(double tool);
  void store() { store(selected_); }

  bool select(double tool);  ///< Returns false if the tool does not exist.
  int selected() const { return selected_; }
  Mix current() const { return {selected_, factors_[static_cast<std::size_t>(selected_)]}; }

 private:
  Factors factors_for(const PerFeeder<double>& shares) const;

  std::size_t feeders_;
  std::int32_t full_scale_;
  PerFeeder<double> collector_{};
  int tools_;
  std::array<Factors, most_tools> factors_{};
  int selected_ = 0;
};

}  // namespace unicursal::sim
