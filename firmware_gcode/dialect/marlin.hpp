// Marlin 2.x with a mixing extruder (sim/README.md, "Mixing in Marlin"). M163 sets one feeder's share in a
// collector, and M164 stores the collector in a virtual tool. The collector keeps its shares, so that all
// feeders are always written. P accepts decimals, and only the ratio of the shares counts. Marlin converts
// them to integers relative to the largest one: 0…32768, which is finer than the four decimals written here,
// or 0…128 on 8-bit boards, which is coarser (up to 0.4 % of the largest share).
#pragma once

#include "firmware_gcode/dialect/dialect.hpp"

namespace unicursal::gcode {

class Marlin : public Dialect {
 public:
  const Limits& limits() const override;
  std::string flavour() const override { return "Marlin"; }
  std::vector<std::string> define_tool(std::size_t tool, const Mixture& mixture) const override;
  std::string select_tool(std::size_t tool) const override;
};

}  // namespace unicursal::gcode
