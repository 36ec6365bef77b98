// Reads, checks and begins to plan a job in a child process, before the daemon itself touches it: a file from
// the net may make a reader take all memory, never end, or crash. The child is this program again (the
// command `check-job`, which no help lists). It gives itself the limits, prints nothing or one sentence, and
// ends.
#pragma once

#include <asio/any_io_executor.hpp>
#include <asio/awaitable.hpp>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <stop_token>
#include <string>

#include "host/engine/prepared_job.hpp"

namespace unicursal::host {

struct CheckLimits {
  std::optional<std::uint64_t> memory;         ///< address space, bytes; absent: unlimited
  std::optional<std::chrono::seconds> time{};  ///< to read the job, also of the processor; absent: unlimited
};

struct JobCheck {
  std::filesystem::path job;
  std::optional<std::filesystem::path> profile;  ///< instead of the job's own
  std::optional<LayerRange> layers;
  CheckLimits limits;
  /// A folder into which the child writes a small picture of the job and an estimate (job_sketch.hpp); a job
  /// is only read then, and nothing of it is planned.
  std::optional<std::filesystem::path> sketch = {};
};

/// Why a job cannot be printed, found by a child process; empty if it can. `stop` ends the child at once:
/// then core::Stopped is thrown. Belongs to the loop's thread. Throws std::system_error if it cannot start.
asio::awaitable<std::string> check_in_child(JobCheck check, std::stop_token stop);

/// The child's part: takes on the limits, reads and prepares the job, and, if there is a limit of time, plans
/// layers of it for half of that. Throws core::DataError, also for a limit that was reached, if the process
/// survives that.
void check_here(const JobCheck& check);

}  // namespace unicursal::host
