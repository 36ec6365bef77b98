// A print in the foreground: it shows its progress, is steered from its terminal, and reports how it ended.
#pragma once

#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include "host/cli/arguments.hpp"
#include "host/cli/exit.hpp"
#include "host/cli/status_line.hpp"
#include "host/engine/print.hpp"
#include "host/engine/stream.hpp"
#include "host/report/totals.hpp"
#include "host/spool/spool.hpp"

namespace unicursal::host {

/// How a print ended, and how long it took.
struct ForegroundResult {
  StreamResult stream;
  double seconds = 0;              ///< with heating, by the clock of the print
  std::optional<double> foretold;  ///< s, the same by the first forecast; absent if there was none
  std::string reason;              ///< why it was stopped or failed
  std::vector<std::string> warnings;
};

/// Streams to the port, whose descriptor it takes over, with a progress line or with events. Complaints of
/// the printer are shown above the line.
ForegroundResult stream_with_progress(int port, Source& source, const DisplayOptions& options,
                                      const StreamSettings& settings = {}, StatusLook look = {});
ForegroundResult stream_with_progress(Print& print, const DisplayOptions& options);

/// For what is not resumed: feeding, and prints for tuning. Opens the port. When the connection is lost,
/// waits until the printer is back, and switches its heaters off. Returns whether the user has stopped it.
/// Throws PortError, PrinterUnfit, PrintError.
bool stream_or_cool(const std::string& port, const Profile& profile, Source& source, StreamSettings settings,
                    StatusLook look = {});

/// The colours of a job's mixtures, for its progress line.
StatusLook look_for(const Job& job);

/// Adds a print that has ended to the history of prints; warns if that is not possible.
void note_in_history(Print& print, const ForegroundResult& result);

/// Shows when and after how long a print was completed, and what had been foretold.
void show_done(const ForegroundResult& result, const DisplayOptions& display);

/// Shows how to resume a print that has not been completed, and problems of its journal.
void show_how_to_resume(Spool& spool, const StreamResult& result);

/// Shows the end of a print that has not failed. Returns its exit code.
Exit show_ending(const StreamResult& result, const DisplayOptions& display);

/// Returns the stream for messages to people: standard error if events take the standard output.
std::FILE* message_stream(const DisplayOptions& display);

}  // namespace unicursal::host
