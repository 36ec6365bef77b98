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
#include "firmware_gcode/toolpath/chunk.hpp"
#include "firmware_gcode/toolpath/placed_layer.hpp"
#include "firmware_gcode/toolpath/printer.hpp"

namespace unicursal::gcode {

/// From this layer on the heaters keep other temperatures; what is absent stays.
struct LayerTemperature {
  std::size_t layer = 0;
  std::optional<double> nozzle, bed;  ///< °C
};

struct Fan {
  double percent = 0;
  std::size_t from = 0;  ///< layer that it starts at
};

/// Rings round the whole first layer.
struct Skirt {
  int loops = 0;
  double distance = 5;  ///< mm from the part's hull to the inner ring's border
};

struct PrintSettings {
  double flow = 2;  ///< mm³/s, held constant; with `automatic_flow` only a first guess
  /// Hold the highest flow that the first layers' hairpins let stay constant, and less in layers that need it
  /// (pace.hpp, held_flow.hpp).
  bool automatic_flow = false;
  std::optional<double> speed;   ///< mm/s, held constant instead of the flow
  double first_layer_speed = 1;  ///< of the flow or speed of the others, 0…1
  double layer_height = 0.2;     ///< mm, of all layers but the first
  double first_layer_height = 0.2;
  std::size_t layer_count = 0;
  Skirt skirt;
  Fan fan;
  std::vector<LayerTemperature> temperatures;  ///< by layer, rising
  std::vector<Material> materials;
  std::vector<std::size_t> zone_materials;  ///< Bead::zone → index into materials
  core::Box extent;                   ///< of the part on the bed, so that the prime line keeps clear of it
  double part_height = 0;             ///< mm, for the park position
  double change_before_border = 0.5;  ///< the share of every change of mixture that falls before its border
  bool look_ahead = true;             ///< false, for comparison: switch where the border is
  Seam seam = Seam::hidden;
  std::size_t horizon = default_horizon;  ///< layers that the route is chosen over together
};

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
