// Repetier 1.0 with a mixing extruder (sim/README.md, "Repetier"). P is an integer, so that shares are
// written in hundredths. M163 changes the weights of the active extruder at once, also for running moves.
// M164 S stores them in a virtual tool. T loads a tool's weights after all motion has ended. Therefore all
// tools are defined at standstill before the print, and each T costs a stop. A move may feed 160 mm; Repetier
// drops longer ones silently. NUM_EXTRUDER is at most 6 (Configuration.h).
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
