// From bead paths to firmware lines: a streaming transducer, layers in, chunks out. Three stages, each a
// file:
//   route (route.hpp)               where every path begins, which way it runs, and the travels in between;
//   schedule (mixing/schedule.hpp)  when the feeders are told to mix anew, by volume ahead;
//   writing (move_writer.hpp)       the lines.
// What is not yet certain is withheld: the route looks a few layers ahead, the schedule some mm³. So a chunk
// holds the lines of what has become certain since the last one: of no layer, a part of one, or several.
// Deposition follows the paper's §4.2: the feeders turn at a constant rate and each segment's speed is
// flow ÷ (bead width × layer height). E is mm of filament, all feeders together (firmware-facts).
//
// On a travel the filament is drawn back by a virtual tool of equal shares, so that every inlet gives way
// alike; when materials take all virtual tools, by the tool in use. The filament is drawn back at the end of
// a print and taken to be so at its beginning.
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

/// Throws core::DataError for a printer or settings that make no sense, a position outside the bed, a
/// zone without material, a flow above the printer's, or a part that begins in the air;
/// nothing of a refused chunk is returned, and the encoder is as it was before.
class Encoder {
 public:
  Encoder(const Printer& printer, const PrintSettings& settings);
  ~Encoder();
  Encoder(Encoder&&) noexcept;

  /// Heat, home, the user's own lines, modes, tools. Once, before any layer.
  Chunk start();
  /// In order, from the first, which begins with the prime line: only here are its height and first mixture
  /// known. Gives what has become certain, perhaps nothing yet.
  Chunk layer(const PlacedLayer& layer);
  /// All that was withheld, after the last layer.
  Chunk rest();
  /// Park, heaters and motors off. At any time after start(), and right wherever the printer has stopped in
  /// what was encoded, with or without rest() before: every state that the lines depend on is in them.
  Chunk finish();

  /// mm³/s; of an automatic flow what has been chosen, which is known from the first layer with a bead on.
  double flow() const;
  /// s from the first bead's start to the end of the last one so far, as the firmware will take them.
  double laying_seconds() const;

  /// The mixture that the firmware will really use for a material: floor share applied, then rounded to
  /// what is written (four decimals for Marlin, two for Repetier) and normalised.
  /// Of a gradient at `part`, 0…1.
  Mixture intended(std::size_t material, double part = 0) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace unicursal::gcode
