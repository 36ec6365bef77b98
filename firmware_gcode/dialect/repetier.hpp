// Repetier 1.0 with a mixing extruder. Firmware facts: P is an integer, so shares are written in parts of a
// hundred; M163 changes the weights of the extruder that is active, at once and for moves that run; M164,
// which needs S, stores them as a virtual tool; T takes a tool's weights and waits for all motion to end. So
// every tool is defined while the machine stands still, before the print, and T comes at a price: a stop.
// One move may feed 160 mm; more is dropped without a word.
#pragma once

#include "firmware_gcode/dialect/dialect.hpp"

namespace unicursal::gcode {

class Repetier : public Dialect {
 public:
  const Limits& limits() const override;
  std::string flavour() const override { return "Repetier"; }
  std::vector<std::string> define_tool(std::size_t tool, const Mixture& mixture) const override;
  std::string select_tool(std::size_t tool) const override;
};

}  // namespace unicursal::gcode
