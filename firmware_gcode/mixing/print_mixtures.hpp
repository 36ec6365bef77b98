// The mixtures of a whole print: those of its materials, the pulses of their overshoots, and the virtual
// tools that hold them at its start. mm³.
#pragma once

#include <vector>

#include "firmware_gcode/dialect/dialect.hpp"
#include "firmware_gcode/mixing/chamber.hpp"
#include "firmware_gcode/mixing/overshoot.hpp"
#include "firmware_gcode/mixing/palette.hpp"
#include "firmware_gcode/mixing/tool_table.hpp"
#include "firmware_gcode/print/material.hpp"
#include "firmware_gcode/print/printer.hpp"

namespace unicursal::gcode {

struct PrintMixtures {
  Palette palette;
  Overshoots overshoots;
  ToolTable tools;
};

/// The model of the printer's chamber.
ChamberModel chamber_of(const Printer& printer);

/// `look_ahead`: changes are switched ahead, with overshoots if the printer has them. `before_border`:
/// fraction of each change that lies before its border. The dialect must outlive the result.
PrintMixtures mixtures_of(const Printer& printer, const std::vector<Material>& materials, bool look_ahead,
                          double before_border, const Dialect& dialect);

}  // namespace unicursal::gcode
