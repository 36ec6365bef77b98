// The folder in which a print is kept while it runs, so that it can go on after this program, the computer or
// the printer has failed: copies of everything that it was begun with, every chunk before its first line is
// sent, and the journal of what was sent.
//
//   ROOT/2026-11-22-101500-heart/print.json   what it is, and how the copies are called
//                                job/…        job, profile, models, direction files
//                                chunks       SpooledChunk records (record_file.hpp)
//                                journal      events (journal.hpp)
//
// What survives: a chunk is on the disk (fdatasync) when append() returns, so that the loss of the computer's
// mains costs none that was sent. The journal is handed to the system at once, which a killed program does
// not undo, and synced once a second.
#pragma once

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

/// What a print was begun with.
struct PrintOrder {
  std::string job_name;                                       ///< for people
  std::string port;                                           ///< as the user said: a path or "auto"
  std::string device;                                         ///< that this was, when the print began
  std::optional<std::pair<std::size_t, std::size_t>> layers;  ///< first and last, if not all
  std::size_t layer_count = 0;                                ///< to be printed
};

class Spool {
 public:
  /// Makes a folder below `root` for a new print; the newest few are kept, older ones removed.
  /// Throws SpoolError.
  static Spool create(const std::filesystem::path& root, const Job& job, const PrintOrder& order);
  /// Opens one that is there, for going on; damaged ends of its files are cut. Throws SpoolError, among
  /// others when another program is at it.
  static Spool open(const std::filesystem::path& folder);
  ~Spool();
  Spool(Spool&&) noexcept;

  const std::filesystem::path& folder() const;
  const PrintOrder& order() const;
  /// The job from its copies, whatever has become of the originals. Throws as load_job() does.
  Job job() const;

  /// Keeps a chunk, durably: may take long. From any one thread. Throws SpoolFull; nothing was kept then.
  void append(const SpooledChunk& chunk);
  std::filesystem::path chunks() const;
  Journal& journal();
  /// The printer is about to move: prints that were interrupted on the same port learn that it is no longer
  /// where they left it.
  void supersede_others() noexcept;
  /// It is of no use: nothing was sent. The folder goes.
  void discard() noexcept;
  /// What the journal told, and what was spooled, when the spool was opened.
  const JournalState& before() const;
  const SpoolExtent& extent() const;

 private:
  struct State;
  explicit Spool(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

/// $XDG_STATE_HOME/unicursal/prints, or ~/.local/state/unicursal/prints. Throws SpoolError without a home.
std::filesystem::path default_spool_root();

/// The folders of prints below `root`, the newest first.
std::vector<std::filesystem::path> kept_prints(const std::filesystem::path& root);

/// One sentence about a kept print: its job, how far it came, how it ended.
std::string describe(const std::filesystem::path& folder);

}  // namespace unicursal::host
