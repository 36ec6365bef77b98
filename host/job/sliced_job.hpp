// Jobs that print a slicer's G-code: their keys, and a job for such a file.
#pragma once

#include <filesystem>
#include <string>

#include "firmware_gcode/sliced/survey.hpp"
#include "host/job/job.hpp"
#include "host/job/settings_file.hpp"

namespace unicursal::host {

/// Reads [part] and [[zone]] of a job whose `source.files` is a slicer's G-code. Throws JobError for keys
/// that make no sense with it. Precondition: the profile has been read.
void read_sliced(const Section& root, const Section& part, Job& job);
/// Throws JobError for keys of [part] that only a slicer's G-code has.
void refuse_sliced_keys(const Section& part);

/// Each tool that the job does not name gets the mixture that the file itself gives it; else the nearest one
/// to the colour of its filament; else one feeder, by its number. Throws JobError if the job names a tool
/// that the file does not use.
void choose_mixtures(Job& job, const gcode::SlicedSurvey& survey);

/// The text of a job for the file, TOML with comments. `folder`: where it is to lie.
std::string sliced_job(const std::filesystem::path& file, const gcode::SlicedSurvey& survey,
                       const Profile& profile, const std::filesystem::path& folder);
/// The same without the tools, which follow the file then.
std::string plain_sliced_job(const std::filesystem::path& file, const std::filesystem::path& profile);

}  // namespace unicursal::host
