// Loading, purging and unloading: lines that move filament where nothing is printed, after which the printer
// is cold again. mm, mm/s, °C.
//
// The axes are homed and the nozzle waits above the front edge of the bed until it has the profile's
// temperature; only then does filament move. The bed's heat stays as it is. As at the start of every print,
// the filament is drawn back at first; so it is at the end.
//
// load, purge   One feeder turns, and each of the others with the profile's floor share: where an inlet
//               stands still under pressure, melt creeps up in it and clogs it. `load` is fast as far as
//               the tube certainly reaches, if the others' filament melts as fast. `purge` of all feeders
//               is one after the other, and then all together.
// unload        All feeders push a little together, which leaves a tip that does not catch in the tube.
//               Then one feeder pulls alone, at once and fast, before the tip sticks. Here the others have
//               no floor share: the sign of E is that of all feeders, so that a share would pull their
//               melt out of their inlets, and draw air in. They stand still only for as long as the pull
//               lasts.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "host/engine/source.hpp"
#include "host/job/profile.hpp"

namespace unicursal::host {

enum class FeedingKind { load, purge, unload };

struct FeedingOrder {
  FeedingKind kind = FeedingKind::load;
  std::optional<std::size_t> feeder;  ///< counted from 0; absent: all of them, which only purge can
  std::optional<double> length;       ///< mm that each of them moves; absent: a usual length
};

struct Feeding {
  FinishedPrint print;
  gcode::Chunk cold_end;  ///< instead of print.finish, as long as no filament has moved
  double length = 0;      ///< mm that each feeder of the order moves
  double seconds = 0;     ///< of moving filament, estimated
};

/// Throws core::DataError for a feeder that the printer does not have, a length beyond 1…2000 mm, or a nozzle
/// that the profile keeps too cold to feed.
Feeding feeding(const FeedingOrder& order, const Profile& profile);

/// Ends without moving filament if it is ended before the nozzle is hot. What it refers to must outlive it.
class FeedingSource final : public FinishedSource {
 public:
  FeedingSource(const Feeding& feeding, const gcode::Printer& printer)
      : FinishedSource(feeding.print, printer), feeding_(feeding) {}

  std::optional<PrintStep> next() override {
    feeds_ = true;
    return FinishedSource::next();
  }
  gcode::Chunk finish() override { return feeds_ ? feeding_.print.finish : feeding_.cold_end; }

 private:
  const Feeding& feeding_;
  bool feeds_ = false;
};

}  // namespace unicursal::host
