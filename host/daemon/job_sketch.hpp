// What a job looks like and will take: made by a child process (job_check.hpp), kept in a folder of the
// daemon's state for as long as the job is in the queue.
#pragma once

#include <filesystem>

#include "host/engine/prepared_job.hpp"
#include "host/engine/prepared_sliced.hpp"

namespace unicursal::host {

inline constexpr const char* sketch_picture = "picture.png";
inline constexpr const char* sketch_estimate = "estimate.json";

/// Writes both files into the folder, which must exist: the picture first, since the estimate may take
/// longer than the child has.
void write_sketch(const std::filesystem::path& folder, const PreparedJob& prepared);
void write_sketch(const std::filesystem::path& folder, const PreparedSliced& prepared);

}  // namespace unicursal::host
