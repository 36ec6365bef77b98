// Marlin 2.x with a mixing extruder: M163 fills a collector, feeder by feeder, and M164 stores it.
// Firmware facts: the collector persists, so that all feeders are always written; P takes decimals and its
// scale does not matter; factors become integers of the largest (0…32768, or 0…128 on 8-bit boards), which
// is finer than the four decimals written here (coarser on 8-bit boards: up to 0.4 % of the largest share).
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
