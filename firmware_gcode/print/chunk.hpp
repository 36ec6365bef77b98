// The encoder's output: a stretch of finished G-code with what a host has to know about it.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "firmware_gcode/print/layer_mixing.hpp"
#include "firmware_gcode/print/mixture.hpp"

namespace unicursal::gcode {

struct MixtureVolume {
  Mixture mixture;
  double volume = 0;  ///< mm³
};

/// Adds the volume to that of an equal mixture if there is one.
void add(std::vector<MixtureVolume>& volumes, const Mixture& mixture, double volume);

/// The part of a chunk that belongs to one layer.
struct LayerShare {
  std::size_t layer = 0;
  double volume = 0;   ///< mm³ laid along beads
  double seconds = 0;  ///< s, estimated
  bool last = false;   ///< later chunks contain no part of this layer
};

/// The feeders change to another mixture at a line of the chunk.
struct MixtureStart {
  std::size_t line = 0;  ///< index of the line that selects the mixture
  /// Of the job's material, or of the feeder that purges its inlet: "feeder 2"; else the shares, such as
  /// "0.02 : 0.74 : 0.24".
  std::string name;

  friend bool operator==(const MixtureStart&, const MixtureStart&) = default;
};

/// From a line of the chunk on, beads are to become this material, whatever is fed and comes out meanwhile.
struct MaterialStart {
  std::size_t line = 0;      ///< index of the line before which that begins
  std::size_t material = 0;  ///< index into the materials of the print
};

/// Lines have no number, no checksum and no newline. Comment lines (starting with ';') belong in files only;
/// they must not be sent to a printer.
struct Chunk {
  std::vector<std::string> lines;
  /// By line, rising; before the first one, the mixture of the chunk before stays in use.
  std::vector<MixtureStart> mixtures;
  std::vector<MaterialStart> asked;  ///< the same for what the beads are to become
  double seconds = 0;                ///< s, estimated
  double volume = 0;                 ///< mm³ extruded along beads and the prime line; excludes retractions
  /// The same volume, by mixture; each mixture once.
  std::vector<MixtureVolume> mixture_volumes;
  double prime_volume = 0;  ///< mm³ of `volume` in the prime line, purges included, and the skirt
  /// Of `mixture_volumes`, what is laid beside the part: the prime volume, and of a slicer's file skirt,
  /// brim, raft, wipe tower and the user's own lines.
  std::vector<MixtureVolume> aside_mixtures;
  std::size_t prime_material = 0;     ///< of the prime volume: index into PrintSettings::materials
  std::vector<LayerShare> layers;     ///< of the lines, in order; empty for the start and the end of a print
  std::vector<LayerMixing> mixing;    ///< forecast for the layers that have become certain
  std::vector<std::string> warnings;  ///< for the user, one sentence each
};

/// Returns whether the line is sent to the firmware; comments and blank lines are not.
bool is_command(const std::string& line);
/// Removes comments and blank lines.
void keep_commands(std::vector<std::string>& lines);
/// Removes them from a chunk and renumbers its mixtures.
void keep_commands(Chunk& chunk);

}  // namespace unicursal::gcode
