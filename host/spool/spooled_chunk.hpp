// A chunk as it is kept: its lines, and the bead paths that they were made from, so that the encoder can be
// brought to the same state again without planning again. What planning took (the effort of every island)
// stands beside them, so that the same curves can also be computed again.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/planner/island_plan.hpp"
#include "firmware_gcode/print/chunk.hpp"
#include "firmware_gcode/print/placed_layer.hpp"

namespace unicursal::host {

/// Where a layer begins among the lines of a chunk.
struct LayerBegun {
  std::uint32_t line = 0;  ///< counted from 0, comments left out
  double top = 0;          ///< mm

  friend bool operator==(const LayerBegun&, const LayerBegun&) = default;
};

struct SpooledChunk {
  enum class Kind : std::uint8_t {
    start,
    layer,  ///< what became certain when the encoder was given a layer; may belong to earlier ones
    rest,   ///< the lines that the encoder had withheld
    finish,
    stretch  ///< the next lines of a slicer's file (host/engine/sliced_production.hpp)
  };
  static constexpr Kind last_kind = Kind::stretch;
  Kind kind = Kind::start;
  gcode::PlacedLayer layer;                   ///< for Kind::layer: what the encoder was given, on the bed, mm
  std::vector<LayerBegun> begun;              ///< in `lines`
  std::vector<gcode::MixtureStart> mixtures;  ///< in `lines`
  std::vector<core::Effort> efforts;          ///< of its islands
  std::vector<std::string> lines;             ///< as sent: no comments
};

/// From the comments of a chunk that has them still.
std::vector<LayerBegun> layers_begun_in(const std::vector<std::string>& lines);

std::string to_bytes(const SpooledChunk& chunk);
/// Throws DamagedBytes.
SpooledChunk chunk_from(std::string_view bytes);

}  // namespace unicursal::host
