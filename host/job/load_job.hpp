// Reads a job file, or makes a job for a model. Lengths in mm.
#pragma once

#include <filesystem>
#include <optional>

#include "host/job/job.hpp"

namespace unicursal::host {

/// Reads and checks a job and the profile it names, or `profile` instead. File names in a job are relative
/// to it. Throws JobError, core::FileError, core::DataError.
Job load_job(const std::filesystem::path& file, const std::optional<std::filesystem::path>& profile = {});

/// What to do for a model if neither a profile is named nor own_profile() exists.
enum class UnnamedPrinter {
  refuse,               ///< a real printer could be another one
  assume_common_frame,  ///< to try a model
};

/// The same, and a model (a drawing or meshes) counts as the job that model_job() writes for it, and a
/// slicer's G-code as a job that names it alone. Without `profile` they are printed with that of
/// own_profile().
Job load_job_or_model(const std::filesystem::path& file, const std::optional<std::filesystem::path>& profile,
                      UnnamedPrinter unnamed);

/// The bead width that results from seeds at distance `d` (the paper's d), both in mm.
double bead_width_from_seed_distance(double d);

}  // namespace unicursal::host
