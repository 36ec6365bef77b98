// Somebody who looks at the lines of a print on their way to the printer (host/live), and what he needs to
// know beside them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "firmware_gcode/print/chunk.hpp"
#include "firmware_gcode/print/material.hpp"
#include "host/spool/spooled_chunk.hpp"

namespace unicursal::host {

/// Called on the loop's thread; to be quick.
class LineFollower {
 public:
  virtual ~LineFollower() = default;
  /// A chunk is kept in the spool, and is sent behind all chunks before. `made`: the same without comments;
  /// its `seconds` and `asked` are not in the spool.
  virtual void chunk_kept(const SpooledChunk& kept, const gcode::Chunk& made) = 0;
  /// Lines of the session's own go to the printer before the print's line `line`.
  virtual void interposed(const std::vector<std::string>& lines, std::uint64_t line) = 0;
};

/// The mixtures that a print asks for, as they are delivered.
struct AskedMaterials {
  std::vector<gcode::Material> materials;
  std::vector<std::size_t>
      zone_materials;  ///< Bead::zone → index into `materials`; empty if nothing is planned
};

/// How far a printer is in a print's lines, which are counted from 0.
struct LinePlace {
  std::uint64_t handed = 0;                   ///< those before this one were passed to the link
  std::uint64_t acknowledged = 0;             ///< those before this one are in the printer's queue, or done
  std::optional<std::uint32_t> queued_moves;  ///< in its queue at the last ok, if it reports that
};

}  // namespace unicursal::host
