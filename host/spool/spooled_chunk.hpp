// A chunk as it is kept: its lines, and the bead paths that they were made from, so that the encoder can be
// brought to the same state again without planning anew. What planning took (the effort of every island)
// stands beside them, so that the same curves can also be computed again.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/planner/plan_island.hpp"
#include "firmware_gcode/toolpath/encoder.hpp"

namespace unicursal::host {

struct SpooledChunk {
  enum class Kind : std::uint8_t { start, layer, finish };
  Kind kind = Kind::start;
  gcode::PlacedLayer layer;           ///< for Kind::layer: what the encoder was given, on the bed, mm
  std::vector<core::Effort> efforts;  ///< of its islands
  std::vector<std::string> lines;     ///< as sent: no comments
};

std::string to_bytes(const SpooledChunk& chunk);
/// Throws DamagedBytes.
SpooledChunk chunk_from(std::string_view bytes);

}  // namespace unicursal::host
