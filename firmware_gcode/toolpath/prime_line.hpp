// A line along the bed's edge that makes the nozzle ready before the part begins: each feeder in turn pushes
// fresh plastic through its inlet, then the nozzle is filled with the first mixture.
#pragma once

#include <cstddef>
#include <optional>

#include "core/geometry/polygon.hpp"
#include "firmware_gcode/print/mixture.hpp"
#include "firmware_gcode/print/printer.hpp"

namespace unicursal::gcode {

struct PrimeLine {
  core::Vec2 from{0, 0}, to{0, 0};  ///< mm, on the bed
  double width = 0;                 ///< mm
  double volume = 0;                ///< mm³, all of it
  double purge = 0;                 ///< mm³ that each feeder pushes out at its beginning; 0: none

  /// Where `volume` of it has been laid.
  core::Vec2 at(double laid) const { return from + (to - from) * (laid / volume); }
};

/// Returns a line along the first of the edges front, left, back, right that keeps clear of `extent`; nullopt
/// if there is no such edge. The line holds twice the transition (dead + mixing volume) if the edge is long
/// enough for the widest bead, and before it, if the printer purges its inlets, as much of each feeder as has
/// room: 4 mm³ if possible. `height` is that of the first layer, mm.
std::optional<PrimeLine> prime_line(const Printer& printer, const core::Box& extent, double height);

/// What leaves the nozzle while a feeder purges its inlet. The others turn as well, so that they do not stand
/// still under its pressure.
Mixture purge_mixture(std::size_t feeder, std::size_t feeders);

}  // namespace unicursal::gcode
