// From bead paths to firmware lines: a streaming transducer that takes layers and returns chunks. It has
// three stages:
//   route (route/route.hpp)         where every path begins, its direction, and the travels in between;
//   schedule (mixing/schedule.hpp)  the volumes at which the feeders switch mixtures;
//   writing (move_writer.hpp)       the lines.
// Lines that are not certain yet are withheld: the route looks a few layers ahead, the schedule a few mm³. So
// a chunk holds the lines that have become certain since the last one: of no layer, a part of one, or
// several. Deposition follows the paper's §4.2: the feeders turn at a constant rate, and each segment's speed
// is flow ÷ (bead width × layer height). E is mm of filament, all feeders together (sim/README.md, "Mixing in
// Marlin").
//
// On a travel, a virtual tool of equal shares draws the filament back, so that all inlets retract alike. If
// the materials need all virtual tools, the tool in use does it. The filament is drawn back at the end of a
// print, and is assumed to be drawn back at its beginning.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/curve/bead_path.hpp"
#include "firmware_gcode/mixing/palette.hpp"
#include "firmware_gcode/print/chunk.hpp"
#include "firmware_gcode/print/placed_layer.hpp"
#include "firmware_gcode/print/print_settings.hpp"
#include "firmware_gcode/print/printer.hpp"

namespace unicursal::gcode {

/// Throws core::DataError for an impossible printer or impossible settings, a position outside the bed, a
/// zone without material, a flow above the printer's, or a part that begins in the air. A refused layer
/// returns no lines and does not change the encoder.
class Encoder {
 public:
  Encoder(const Printer& printer, const PrintSettings& settings);
  ~Encoder();
  Encoder(Encoder&&) noexcept;

  /// Heat, home, the user's own lines, modes, tools. Must be called once, before any layer.
  Chunk start();
  /// Adds the next layer and returns the lines that have become certain, which may be none. The first layer
  /// begins with the prime line, whose height and mixture are known only here.
  Chunk layer(const PlacedLayer& layer);
  /// Returns all withheld lines, after the last layer.
  Chunk rest();
  /// Parks the nozzle and turns heaters and motors off. May be called at any time after start(), with or
  /// without rest(): the lines set every state they need, so that they are correct wherever the printer has
  /// stopped.
  Chunk finish();

  /// The flow, mm³/s. An automatic flow is known when the first layer with beads has been written.
  double flow() const;
  /// The estimated time from the start of the first bead to the end of the last one so far, s.
  double laying_seconds() const;

  /// The mixture that will be delivered for a material: with the floor share, rounded to what is written
  /// (four decimals for Marlin, two for Repetier) and normalised. `part` is the position along a gradient,
  /// 0…1.
  Mixture intended(std::size_t material, double part = 0) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace unicursal::gcode
