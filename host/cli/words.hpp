// Steps and sentences that several commands share.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "host/cli/commands.hpp"
#include "host/engine/stream.hpp"

namespace unicursal::host {

/// Loads, checks and places a job; its warnings go to standard error.
PreparedJob prepare_and_warn(const JobOptions& options);

/// The report's "planning": seconds, cpu_seconds, threads.
nlohmann::json planning_json(const Lookahead& lookahead);
/// The report's "link".
nlohmann::json link_json(const StreamResult& result);

/// Streams with a progress line; what the printer complains about is shown above it.
StreamResult stream_with_progress(int port, Lookahead& lookahead, Run& run, const std::string& what);

}  // namespace unicursal::host
