// The encoder's product: a stretch of finished firmware text with what it means.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "firmware_gcode/print/layer_mixing.hpp"
#include "firmware_gcode/print/mixture.hpp"

namespace unicursal::gcode {

/// Lines carry no number, no checksum and no newline; comment lines (starting with ';') belong in files
/// only and must not be sent over the wire.
struct MixtureVolume {
  Mixture mixture;
  double volume = 0;  ///< mm³
};

void add(std::vector<MixtureVolume>& volumes, const Mixture& mixture, double volume);

/// A layer's share of a chunk.
struct LayerShare {
  std::size_t layer = 0;
  double volume = 0;   ///< mm³ along beads
  double seconds = 0;  ///< estimated
  bool last = false;   ///< nothing of the layer is left for later chunks
};

/// From a line on, the feeders turn for another mixture.
struct MixtureStart {
  std::size_t line = 0;  ///< index of the line that selects the mixture
  std::string name;      ///< of the job's material; else the shares, such as "0.02 : 0.74 : 0.24"

  friend bool operator==(const MixtureStart&, const MixtureStart&) = default;
};

struct Chunk {
  std::vector<std::string> lines;
  /// By line, rising; before the first one, the mixture of the chunk before stays in use.
  std::vector<MixtureStart> mixtures;
  double seconds = 0;  ///< estimated printing time
  double volume = 0;   ///< mm³ extruded along beads, prime line included, retractions not
  /// The same by mixture that the feeders are told, each once.
  std::vector<MixtureVolume> mixture_volumes;
  double prime_volume = 0;            ///< mm³ of `volume` that went into the prime line and the skirt
  std::size_t prime_material = 0;     ///< index as in PrintSettings::materials, of the prime volume
  std::vector<LayerShare> layers;     ///< that the lines belong to, in order; none for the start and the end
  std::vector<LayerMixing> mixing;    ///< what the schedule will make of layers that have become certain
  std::vector<std::string> warnings;  ///< what a person should know before printing, one sentence each
};

/// Whether the firmware gets this line; comments and blank lines belong in files.
bool is_command(const std::string& line);
/// Removes the lines that belong in files only.
void keep_commands(std::vector<std::string>& lines);
/// The same for a whole chunk: the lines that its mixtures start at are counted again.
void keep_commands(Chunk& chunk);

}  // namespace unicursal::gcode
