// From bead paths to firmware lines: a streaming transducer, layer in, chunk out.
// Deposition follows the paper's §4.2: the feeders turn at a constant rate and each segment's speed is
// flow ÷ (bead width × layer height). E is mm of filament, all feeders together (firmware-facts).
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "core/curve/bead_path.hpp"
#include "firmware_gcode/mixing/mixture.hpp"
#include "firmware_gcode/toolpath/printer.hpp"

namespace unicursal::gcode {

/// A mixture with the name that the job gives it.
struct Material {
  std::string name;
  Mixture mixture;  ///< as asked by the job; floor share and quantisation are the encoder's business
};

struct PrintSettings {
  double flow = 2;                  ///< mm³/s
  std::vector<Material> materials;  ///< at most 16, one virtual tool each
  std::vector<std::size_t> zone_materials;  ///< Bead::zone → index into materials
  core::Box extent;                 ///< of the part on the bed, so that the prime line keeps clear of it
  double part_height = 0;           ///< mm, for the park position
};

/// One layer ready to print: bead paths in the bed's frame.
struct PlacedLayer {
  std::size_t index = 0;
  double top = 0;     ///< mm, where the nozzle runs
  double height = 0;  ///< mm
  std::vector<core::BeadPath> paths;
};

/// Finished text with what it means. Lines carry no number, no checksum and no newline; comment lines
/// (starting with ';') belong in files only and must not be sent over the wire.
struct Chunk {
  std::vector<std::string> lines;
  double seconds = 0;  ///< estimated printing time
  double volume = 0;   ///< mm³ extruded
};

/// Preconditions: settings name at least one material, every zone has one. Throws core::DataError for a
/// position outside the bed, more than 16 materials, or a value the printer cannot do; nothing of a
/// refused chunk is returned.
class Encoder {
 public:
  Encoder(const Printer& printer, const PrintSettings& settings);
  ~Encoder();
  Encoder(Encoder&&) noexcept;

  Chunk start();                          ///< heat, home, tools, prime
  Chunk layer(const PlacedLayer& layer);  ///< in order, from the first
  Chunk finish();                         ///< park, heaters off

  /// The mixture that the firmware will really use for a material: floored and quantised.
  Mixture intended(std::size_t material) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace unicursal::gcode
