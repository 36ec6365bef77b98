// A line along the bed's edge that fills the nozzle with the first mixture before the part begins.
#pragma once

#include <optional>

#include "core/geometry/polygon.hpp"
#include "firmware_gcode/print/printer.hpp"

namespace unicursal::gcode {

struct PrimeLine {
  core::Vec2 from{0, 0}, to{0, 0};  ///< mm, on the bed
  double width = 0;                 ///< mm
  double volume = 0;                ///< mm³
};

/// Returns a line along the first of the edges front, left, back, right that keeps clear of `extent`; nullopt
/// if there is no such edge. The line holds twice the transition (dead + mixing volume) if the edge is long
/// enough for the widest bead. `height` is that of the first layer, mm.
std::optional<PrimeLine> prime_line(const Printer& printer, const core::Box& extent, double height);

}  // namespace unicursal::gcode
