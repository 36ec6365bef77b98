// Going on with a print whose printer has lost its place: from where, and what is known of that.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "host/engine/chunk_maker.hpp"
#include "host/engine/prepared_job.hpp"
#include "host/engine/stream.hpp"
#include "host/spool/chunk_reader.hpp"
#include "host/spool/spool.hpp"

namespace unicursal::host {

struct Restart {
  Leg leg;                          ///< to begin; from the print's start when nothing had been laid yet
  std::optional<LayerPlace> layer;  ///< where it goes on
  std::uint64_t repeated = 0;       ///< lines, at most, that the printer may have run before and runs again
  double lowest = 0, highest = 0;   ///< mm, between which the nozzle stands now; the lower one is assumed
  double drawn = 0;                 ///< mm of filament by which it is drawn back
  std::vector<std::string> warnings;

  bool from_start() const { return leg.begins_at == 0; }
};

/// Everything before the place is certain: a firmware acknowledges a move when it is planned, so the last
/// ones acknowledged may be undone unless it has told otherwise (`lost.place`) or the print had been ended
/// in order, or held aside. Precondition: `prepared` is the spool's job.
Restart restart_after(const PreparedJob& prepared, const Spool& spool, const Lost& lost);

/// Brings a fresh chunk maker to where the spool's last chunk has left the encoder. Throws SpoolError if it
/// makes other lines than were spooled.
void catch_up(ChunkMaker& maker, const Spool& spool);

}  // namespace unicursal::host
