// The layers of a print as far as they are known: laid, on their way to the printer, or only planned.
// Finished layers beyond a bound of memory go to a file without a name in the print's folder; a disk without
// room loses them. mm.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "host/files/descriptor.hpp"
#include "host/live/laid_path.hpp"

namespace unicursal::host {

struct KnownLayer {
  std::size_t layer = 0;  ///< counted from 0 among those printed
  double top = 0;
  std::size_t beads = 0;
  bool complete = false;  ///< no more will come
  bool planned = false;   ///< not encoded yet: beads in any order, in the colours asked for
};

/// The end of a layer's way, from one bead on.
struct PathPiece : KnownLayer {
  std::size_t first = 0;      ///< index of the first bead
  LaidPath::Place begin;      ///< of that bead
  std::uint8_t revision = 0;  ///< another one: records that were given before are void
  std::string records;

  /// Leaves out the beads before this one. Precondition: none was left out yet.
  void keep_from(std::size_t from);
};

class LiveLayers {
 public:
  /// Bytes of records that stay in memory.
  static constexpr std::size_t most_in_memory = 4 * 1024 * 1024;

  /// `folder`: for the file; empty: none.
  explicit LiveLayers(std::filesystem::path folder) : folder_(std::move(folder)) {}

  std::size_t size() const { return layers_.size(); }
  /// The layer before ends, and the next one begins.
  void begin(double top);
  /// The last one ends.
  void end();
  /// Of the layer that has begun last: the height of its beads, and its way, which begins at `from` if it has
  /// not begun yet. Precondition: size() > 0.
  double height() const { return layers_.back().height; }
  LaidPath& path(const core::Vec2& from);
  std::size_t beads() const { return layers_.empty() ? 0 : layers_.back().beads(); }
  /// Whether layers have grown since somebody may have heard of them; clears that.
  std::vector<KnownLayer> take_changed();

  /// A layer is planned; the plan is forgotten when the layer ends.
  void plan(std::size_t layer, double top, LaidPath path);
  /// Whether the layer has begun, or its plan is here already.
  bool knows(std::size_t layer) const { return layer < layers_.size() || planned_.contains(layer); }

  struct Mark {
    std::size_t layers = 0, beads = 0;
  };
  Mark mark() const { return {layers_.size(), beads()}; }
  /// Forgets what came behind the mark.
  void back_to(const Mark& mark);

  std::vector<KnownLayer> known() const;
  /// A layer's way that was found, and perhaps still lies on the disk.
  struct Found {
    PathPiece piece;  ///< with all records, unless they are on the disk
    std::optional<std::uint64_t> offset;
  };
  /// Absent if the layer is not known, or not any more.
  std::optional<Found> find(std::size_t layer) const;
  /// What was found, from the bead `from` on; behind the last bead: an empty piece. May read the disk, also
  /// while another thread changes the layers. Absent if it cannot be read.
  std::optional<PathPiece> piece(Found found, std::size_t from) const;

  /// The next layer before `layer` that is to be brought to the disk, until the rest has room in memory.
  std::optional<std::size_t> next_to_move(std::size_t layer);
  /// Writes it, which may take long; changes nothing that others look at. Absent: the disk has no room.
  std::optional<std::uint64_t> write_out(std::size_t layer);
  /// It is there now, at this offset; or it is lost.
  void moved(std::size_t layer, std::optional<std::uint64_t> offset);
  /// The plan of a layer that has not ended; absent if there is none.
  std::optional<PathPiece> plan_of(std::size_t layer) const;

 private:
  struct Layer {
    double top = 0, height = 0;
    std::optional<LaidPath> path;  ///< absent before its first motion, and when it is on the disk
    std::size_t on_disk = 0;       ///< beads, if it is there
    std::optional<std::uint64_t> offset;
    LaidPath::Place first;
    bool complete = false, lost = false, changed = true;
    std::uint8_t revision = 0;

    std::size_t beads() const { return path ? path->size() : on_disk; }
    KnownLayer known(std::size_t number) const { return {number, top, beads(), complete, false}; }
  };
  struct Planned {
    double top = 0;
    LaidPath path;
    bool changed = true;
  };
  const std::filesystem::path folder_;
  std::vector<Layer> layers_;
  std::map<std::size_t, Planned> planned_;  ///< also of the layer that has begun last
  Descriptor file_;                         ///< is open before the first offset in it is known
  bool no_file_ = false;
  std::uint64_t file_size_ = 0;
  std::size_t moved_ = 0;  ///< layers before this one are not in memory
  std::uint8_t revision_ = 0;
};

}  // namespace unicursal::host
