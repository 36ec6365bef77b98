// The line of a print that goes on, as it grows: where the nozzle is and was, in the mixtures that really
// leave it. It follows the lines that the session keeps and sends (planned curves and a slicer's G-code
// alike), reads each once in a thread of its own of lower priority, and passes what the feeders push through
// the model of the chamber. A print that continues is read from its spool first.
//
// What comes between two lines of the print (a pause that squeezes plastic out, M221) changes what leaves the
// nozzle behind it: the lines from there on are read again. Departures: of a print that continues, pauses of
// earlier runs, and all restarts before the last one, are not known; they are washed out after some 10 mm³.
//
// Memory: 9 bytes for each bead of the layers at hand (live_layers.hpp) and of those planned ahead, and some
// 110 bytes for each line that is kept and not executed, which is at most a chunk's and mostly a layer's.
//
//   LiveLine live(subject);
//   settings.follower = &live;
//   if (const auto nozzle = live.nozzle(session.line_place(), now, 100)) show(*nozzle);
//
// The functions may be called on any thread, one at a time; layer_planned() also beside the others. mm, mm³,
// s.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/picture/image.hpp"
#include "host/engine/line_follower.hpp"
#include "host/job/filament.hpp"
#include "host/live/live_layers.hpp"
#include "host/loop/clock.hpp"
#include "host/spool/journal.hpp"

namespace unicursal::host {

/// What is followed.
struct LiveSubject {
  gcode::Printer printer;
  Filaments filaments;
  AskedMaterials asked;
  std::size_t layers = 0;        ///< of the whole print
  std::filesystem::path folder;  ///< for layers that have no room in memory (live_layers.hpp)
  /// For a print that continues: the chunks that are kept already.
  struct Kept {
    std::filesystem::path chunks;
    std::size_t count = 0;
    Leg leg;                     ///< that goes on
    std::uint64_t executed = 0;  ///< the print's lines before this one were executed
  };
  std::optional<Kept> kept;
};

struct NamedMixture {
  std::string name;
  gcode::Shares shares;
  picture::Colour colour;
};

struct LiveOverview {
  std::size_t layers = 0;               ///< of the whole print
  std::vector<NamedMixture> filaments;  ///< pure
  std::vector<NamedMixture> mixtures;   ///< those asked for
  std::vector<KnownLayer> known;
};

/// What the nozzle does now.
struct LiveNozzle {
  std::optional<std::size_t> layer;  ///< absent before the first
  std::size_t bead = 0;              ///< of the layer's records
  core::Vec2 at{0, 0};
  double z = 0;
  NamedMixture fed;
  NamedMixture leaving;  ///< `name`: of the nearest mixture that is asked for
  struct Change {
    double seconds = 0;
    NamedMixture to;
  };
  std::optional<Change> change;  ///< the next one at the feeders, as far as it is known
};

class LiveLine final : public LineFollower {
 public:
  explicit LiveLine(LiveSubject subject);
  ~LiveLine() override;

  void chunk_kept(const SpooledChunk& kept, const gcode::Chunk& made) override;
  void interposed(const std::vector<std::string>& lines, std::uint64_t line) override;
  /// A layer waits to be encoded. It takes some milliseconds: it belongs on a planning thread.
  void layer_planned(const gcode::PlacedLayer& layer);
  /// The printer has executed the lines before this one: they need not be kept at hand.
  void executed(std::uint64_t line);

  LiveOverview overview() const;
  /// A layer's way from the bead `from` on; behind the last bead: an empty piece. Absent if the layer is not
  /// known, or not any more. May read the disk.
  std::optional<PathPiece> path(std::size_t layer, std::size_t from) const;
  /// As LiveLayers::plan_of().
  std::optional<PathPiece> plan(std::size_t layer) const;
  /// Absent before the first move, and while the spool is still being read. `speed`: M220, per cent.
  std::optional<LiveNozzle> nozzle(const LinePlace& place, TimePoint now, double speed);
  /// The layers that have become known or have grown since the last call.
  std::vector<KnownLayer> take_changed();
  /// Returns when everything that was handed over is read.
  void wait() const;

 private:
  struct State;
  const std::unique_ptr<State> state_;
};

}  // namespace unicursal::host
