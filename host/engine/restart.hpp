// Continuing a print whose printer has lost its place: where to continue, and how certain that is.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "host/engine/production.hpp"
#include "host/engine/session_types.hpp"
#include "host/spool/chunk_reader.hpp"
#include "host/spool/spool.hpp"

namespace unicursal::host {

struct Restart {
  Leg leg;                          ///< to begin; at the print's start if nothing had been laid yet
  std::optional<LayerPlace> layer;  ///< where it continues
  std::uint64_t repeated = 0;       ///< at most so many lines are executed a second time
  /// If the journal has lost its end, at most so many; 0 if it has not.
  std::uint64_t perhaps = 0;
  double lowest = 0, highest = 0;  ///< mm, bounds of the nozzle's height; the lower one is assumed
  double drawn = 0;                ///< mm of filament that is retracted
  std::vector<std::string> warnings;

  bool from_start() const { return leg.begins_at == 0; }
};

/// Everything before the returned place has certainly been executed. A firmware acknowledges a move when it
/// is planned, so the last acknowledged moves may be missing, unless the printer reported its place
/// (`lost.place`), or the print had been ended or paused in order. Precondition: `production` is that of the
/// spool's job. Throws SpoolError if a layer was ever spooled but no place is certain: the start lines, which
/// home z, never run on a part, even if journal and chunks were both cut back.
Restart restart_after(const Production& production, const Spool& spool, const Lost& lost);

/// Why a kept print cannot go on with its next line although its printer may be on, as far as the journal
/// says; absent: the printer has to be asked.
std::optional<Lost> lost_before(const JournalState& journal);

/// Throws SpoolError if another print has begun on the print's printer since. Returns the name of a later
/// print that may have been on another printer, which only a person knows; empty: none. `port`: on which it
/// shall continue, if that is not the one on which it began.
std::string check_not_superseded(const Spool& spool, const std::optional<std::string>& port);

/// What a person has to know before a print continues after its printer has lost its place: sentences, one a
/// line.
std::string restart_in_words(const Restart& restart, const Lost& lost, const Spool& spool);

}  // namespace unicursal::host
