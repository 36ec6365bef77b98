// The folder in which a print is kept while it runs, so that it can be resumed after this program, the
// computer or the printer has failed: copies of its input, every chunk before its first line is sent, and the
// journal of what was sent (host/spool/README.md).
//
//   ROOT/2026-11-22-101500-heart/print.json   the print, and the names of the copies
//                                job/…        job, profile, models, direction files
//                                chunks       SpooledChunk records (host/spool/record_file.hpp)
//                                journal      events (host/spool/journal.hpp)
//                                untouched    until the first layer is kept; then it is removed
//
// A chunk is on the disk (fdatasync) when append() returns, so a power cut of the computer loses no chunk
// that was sent. The journal is written at once, which survives the end of this program, and synced once a
// second and before each chunk. So a sound journal always reaches the last chunk, and a sound file of chunks
// everything that the journal says was sent; open() refuses a spool of which this is not true.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "host/job/job.hpp"
#include "host/spool/chunk_reader.hpp"
#include "host/spool/journal.hpp"
#include "host/spool/spooled_chunk.hpp"

namespace unicursal::host {

/// The parameters with which a print was begun.
struct PrintOrder {
  std::string job_name;                                       ///< Name for display.
  std::string port;                                           ///< Port as the user gave it: a path or "auto".
  std::string device;                                         ///< Device of the port when the print began.
  std::optional<std::pair<std::size_t, std::size_t>> layers;  ///< First and last layer; nullopt = all.
  std::size_t layer_count = 0;                                ///< Number of layers to print.
};

class Spool {
 public:
  /// Makes a folder below `root` for a new print. The newest few prints are kept, older ones are removed.
  /// Throws SpoolError; nothing is left behind then.
  static Spool create(const std::filesystem::path& root, const Job& job, const PrintOrder& order);
  /// Opens an existing folder to resume its print; torn ends of its files are cut off. Throws SpoolError if
  /// anything in it is damaged, or if another program uses it.
  static Spool open(const std::filesystem::path& folder);
  ~Spool();
  Spool(Spool&&) noexcept;

  const std::filesystem::path& folder() const;
  const PrintOrder& order() const;
  /// Loads the job from its copies, so the originals may have changed. Throws as load_job() does.
  Job job() const;

  /// Writes a chunk durably, which may take long. One thread at a time. Throws SpoolFull; the chunk was then
  /// not kept.
  void append(const SpooledChunk& chunk);
  std::filesystem::path chunks() const;
  Journal& journal();
  /// To be called before the printer moves: marks interrupted prints on the same port as superseded, since
  /// the printer leaves the position where they stopped.
  void supersede_others() noexcept;
  /// Removes the folder, if nothing was sent.
  void discard() noexcept;
  /// Reads journal and chunks again, for a print that goes on after its session has ended. Throws SpoolError.
  void look_again();
  /// When the spool was last written to before it was opened; absent: it was made by create().
  std::optional<std::chrono::system_clock::time_point> last_written() const;
  /// The contents of the journal and the extent of the chunks when the spool was opened or looked at again.
  const JournalState& before() const;
  const SpoolExtent& extent() const;
  /// Whether no layer was ever kept, so that no line of the part can have been sent. False also if that is
  /// not known.
  bool untouched() const;

 private:
  struct State;
  explicit Spool(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

/// $XDG_STATE_HOME/unicursal/prints, or ~/.local/state/unicursal/prints. Throws SpoolError if there is no
/// home folder.
std::filesystem::path default_spool_root();

/// The folders of the kept prints below `root`, the newest first. They are counted when they begin, since
/// clocks go back. A print whose number cannot be read counts as the newest, so that no older one is taken
/// for it.
std::vector<std::filesystem::path> kept_prints(const std::filesystem::path& root);

/// The later prints below the same root that have moved a printer.
struct LaterPrints {
  std::string same;   ///< the name of the newest one on the same printer; empty: there is none
  std::string other;  ///< of the newest one that may have been on another printer; empty: there is none
};

/// `port`: the port on which the print shall continue, if it is not the one on which it began.
LaterPrints later_prints(const Spool& spool, const std::optional<std::string>& port);

/// One line about a kept print: its job, its progress, and how it ended.
std::string describe(const std::filesystem::path& folder);

}  // namespace unicursal::host
