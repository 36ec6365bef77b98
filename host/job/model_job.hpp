// Writes a job for a model: one zone for each colour or body, and defaults that suit the printer.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/model/inspect_model.hpp"
#include "host/job/profile.hpp"

namespace unicursal::host {

struct ModelJob {
  std::string text;              ///< TOML with comments
  core::ModelContents contents;  ///< of the model that it was written for
};

/// `folder`: where the job is to lie; files are named relative to it if they are below it. The layers are
/// half as high as the nozzle is wide, at most 0.3 mm; beads are 1.25 nozzles wide. Each colour gets the
/// mixture of the profile's filaments that comes nearest to it; bodies without colours get one feeder each,
/// in turn. Throws core::FileError or core::ModelError if the model cannot be read.
ModelJob model_job(const std::vector<std::filesystem::path>& files, const Profile& profile,
                   const std::filesystem::path& folder);

/// How deep paint reaches if a job does not say it, mm.
double usual_paint_depth(double bead_width);

/// The bead width that model_job() chooses, mm.
double usual_bead_width(const gcode::Printer& printer);

}  // namespace unicursal::host
