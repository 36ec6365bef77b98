// From bead paths to firmware lines: a streaming transducer, layer in, chunk out.
// Deposition follows the paper's §4.2: the feeders turn at a constant rate and each segment's speed is
// flow ÷ (bead width × layer height). E is mm of filament, all feeders together (firmware-facts).
//
// Every layer is printed path by path, the nearest first, each from its vertex nearest to the nozzle all
// the way round and back to it (no look-ahead over layers yet). A move of more than 1.5 bead widths to
// such a start is a travel: the filament is drawn back by a virtual tool of equal shares, so that every
// inlet gives way alike; when materials take all virtual tools, by the tool in use.
// The filament is drawn back at the end of a print and taken to be so at its beginning.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "core/curve/bead_path.hpp"
#include "firmware_gcode/mixing/mixture.hpp"
#include "firmware_gcode/toolpath/chunk.hpp"
#include "firmware_gcode/toolpath/printer.hpp"

namespace unicursal::gcode {

/// A mixture with the name that the job gives it.
struct Material {
  std::string name;
  Mixture mixture;  ///< as asked by the job; floor share and quantisation are the encoder's business
};

struct PrintSettings {
  double flow = 2;                          ///< mm³/s
  std::vector<Material> materials;          ///< at most 16, one virtual tool each
  std::vector<std::size_t> zone_materials;  ///< Bead::zone → index into materials
  core::Box extent;        ///< of the part on the bed, so that the prime line keeps clear of it
  double part_height = 0;  ///< mm, for the park position
};

/// One layer ready to print: bead paths in the bed's frame.
struct PlacedLayer {
  std::size_t index = 0;
  double top = 0;     ///< mm, where the nozzle runs
  double height = 0;  ///< mm
  std::vector<core::BeadPath> paths;
};

/// Throws core::DataError for a printer or settings that make no sense, a position outside the bed, more
/// than 16 materials, a zone without material, a flow above the printer's, or a part that begins in the air;
/// nothing of a refused chunk is returned, and the encoder is as it was before.
class Encoder {
 public:
  Encoder(const Printer& printer, const PrintSettings& settings);
  ~Encoder();
  Encoder(Encoder&&) noexcept;

  /// Heat, home, the user's own lines, modes, tools. Once, before any layer.
  Chunk start();
  /// In order, from the first, which begins with the prime line: only here are its height and first
  /// mixture known.
  Chunk layer(const PlacedLayer& layer);
  /// Park, heaters and motors off. At any time after start(), and right wherever the printer has stopped in
  /// what was encoded: every state that the lines depend on is in them.
  Chunk finish();

  /// The mixture that the firmware will really use for a material: floor share applied, then rounded to
  /// what is written (four decimals for Marlin) and normalised.
  Mixture intended(std::size_t material) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace unicursal::gcode
