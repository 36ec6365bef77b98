// A print in the foreground: it shows its progress, is steered from its terminal, and reports how it ended.
#pragma once

#include <cstdio>

#include "host/cli/arguments.hpp"
#include "host/cli/exit.hpp"
#include "host/engine/print.hpp"
#include "host/engine/stream.hpp"
#include "host/spool/spool.hpp"

namespace unicursal::host {

/// Streams to the port, whose descriptor it takes over, with a progress line or with events. Complaints of
/// the printer are shown above the line.
StreamResult stream_with_progress(int port, Source& source, const DisplayOptions& options,
                                  const StreamSettings& settings = {});
StreamResult stream_with_progress(Print& print, const DisplayOptions& options);

/// Shows how to resume a print that has not been completed, and problems of its journal.
void show_how_to_resume(Spool& spool, const StreamResult& result);

/// Shows the end of a print that has not failed. Returns its exit code.
Exit show_ending(const StreamResult& result, const DisplayOptions& display);

/// Returns the stream for messages to people: standard error if events take the standard output.
std::FILE* message_stream(const DisplayOptions& display);

}  // namespace unicursal::host
