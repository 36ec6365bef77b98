// Adds a print that has ended to the history: what its spool says, with what only its last session knows.
// The filament is counted from the lines that were passed to the printer, in all sessions of the print: what
// a restart purges and repeats is among it. A flow that was changed by hand (M221) is not counted.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "host/engine/production.hpp"
#include "host/history/past_print.hpp"
#include "host/spool/spool.hpp"

namespace unicursal::host {

/// The last session of a print.
struct EndedSession {
  std::string job;                 ///< a daemon's name for the job; empty: the path of its file
  std::string reason;              ///< why the print was not completed, a sentence
  std::optional<double> seconds;   ///< that it took
  std::optional<double> foretold;  ///< s, by its first forecast
  std::vector<std::string> warnings;
};

/// What the history is to keep of a print.
struct HistoryEntry {
  std::filesystem::path root;  ///< the folder of the prints
  PastPrint print;
  std::string picture;
  bool goes_on = false;
  double seconds_before = 0;  ///< that sessions took which have left no row
};

/// Reads the spool. Absent: nothing of the print was sent. Throws SpoolError.
std::optional<HistoryEntry> history_entry(Spool& spool, const Production& production,
                                          const EndedSession& ended);
struct KeptInHistory {
  bool written = false;            ///< the history has the print
  std::vector<std::string> notes;  ///< sentences for the user
};
/// Waits a few seconds for other programs that use the history.
KeptInHistory keep_in_history(HistoryEntry entry) noexcept;

/// Both. Never fails: returns sentences for the user.
std::vector<std::string> keep_in_history(Spool& spool, const Production& production,
                                         const EndedSession& ended) noexcept;

}  // namespace unicursal::host
