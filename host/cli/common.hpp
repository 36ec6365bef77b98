// Steps and sentences that several commands share.
#pragma once

#include <cstdio>
#include <initializer_list>

#include "host/cli/commands.hpp"
#include "host/engine/print.hpp"
#include "host/engine/stream.hpp"
#include "host/spool/spool.hpp"

namespace unicursal::host {

/// Throws core::DataError for an output that is one of the inputs, or another output.
void check_outputs(std::vector<std::filesystem::path> inputs,
                   const std::vector<std::filesystem::path>& outputs);

/// Those that were given.
std::vector<std::filesystem::path> present(std::initializer_list<std::optional<std::filesystem::path>> paths);

/// Loads, checks and places a job; its warnings go to standard error. Refuses outputs, those of the options
/// and `more`, that are one of the job's own files or one another.
PreparedJob prepare_and_warn(const JobOptions& options, const std::vector<std::filesystem::path>& more = {});

/// How a print that can be resumed is resumed.
void tell_about_spool(Spool& spool, const StreamResult& result);

/// The last words of a print that has not failed, and its exit code.
Exit tell_ending(const StreamResult& result, const DisplayOptions& display);

/// Where words for people go: events have the standard output for themselves.
std::FILE* words_of(const DisplayOptions& display);

/// Streams with a progress line, or events; what the printer complains about is shown above it.
StreamResult stream_with_progress(int port, Source& source, const DisplayOptions& options,
                                  const StreamSettings& settings = {});
StreamResult stream_with_progress(Print& print, const DisplayOptions& options);

}  // namespace unicursal::host
