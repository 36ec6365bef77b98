// The encoder's product: a stretch of finished firmware text with what it means.
#pragma once

#include <string>
#include <vector>

namespace unicursal::gcode {

/// Lines carry no number, no checksum and no newline; comment lines (starting with ';') belong in files
/// only and must not be sent over the wire.
struct Chunk {
  std::vector<std::string> lines;
  double seconds = 0;  ///< estimated printing time
  double volume = 0;   ///< mm³ extruded along beads, prime line included, retractions not
  /// The same by material: index as in PrintSettings::materials.
  std::vector<double> material_volumes;
  double prime_volume = 0;            ///< mm³ of `volume` that went into the prime line and the skirt
  std::vector<std::string> warnings;  ///< what a person should know before printing, one sentence each
};

}  // namespace unicursal::gcode
