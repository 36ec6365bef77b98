// A job: which part to print, how, and on what printer, as written in a TOML file.
// Lengths in mm, flow in mm³/s, angles in radians (degrees in the file).
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/model/part.hpp"
#include "core/model/pose.hpp"
#include "firmware_gcode/print/print_settings.hpp"
#include "host/job/job_error.hpp"
#include "host/job/profile.hpp"

namespace unicursal::host {

/// Where the part goes on the bed.
struct Placement {
  enum class Kind { center, as_is, at };
  Kind kind = Kind::center;
  core::Vec2 point{0, 0};  ///< mm on the bed, the centre of the part's extent, for Kind::at
};

/// A further part on the plate.
struct PlatePart {
  core::PartSource source;  ///< with the zones and layers of the first part
  core::Shaping shaping;
  std::size_t copies = 1;
};

/// How a slicer's G-code is printed (host/job/sliced_job.hpp).
struct SlicedChoices {
  std::map<int, std::size_t> tools;  ///< of the file → index into the job's materials
  bool tower = true;                 ///< its wipe tower is printed
  bool allow_stops = false;          ///< it may wait for a person
};

struct Job {
  std::filesystem::path file;
  std::string text;  ///< of a job that was written for a model, which is `file` then; empty: the file's own
  core::PartSource source;  ///< zones name materials by their index in `print.materials`
  core::Shaping shaping;
  std::size_t copies = 1;       ///< of the part of `source`
  std::vector<PlatePart> more;  ///< further parts
  /// `source` is a slicer's G-code, and nothing else of the part counts; absent: curves are planned.
  std::optional<SlicedChoices> sliced;
  double gap = 5;           ///< mm between parts and copies
  bool one_by_one = false;  ///< parts and copies are printed one after the other, not layer by layer
  double bead_width = 0;
  std::optional<double> seed_distance;
  int perimeters = 0;                ///< contours around the fill
  bool allow_bare = false;           ///< layers may stay mostly without plastic, because they are too thin
  std::optional<double> line_width;  ///< of a thin line that shows the curve; absent: beads fill their area
  Placement place;
  gcode::PrintChoices print;  ///< `look_ahead` is set by the command line only
  bool full_quality = false;  ///< set by the command line: planning never hurries, the nozzle may wait
  Profile profile;
  std::vector<std::string> warnings;  ///< about keys that have no effect yet, one sentence each
};

/// The files that a print of a job is made from.
struct JobInputs {
  std::filesystem::path job;  ///< empty for a job that was written for a model
  std::filesystem::path profile;
  std::vector<std::filesystem::path> models;
  std::vector<std::filesystem::path> fields;  ///< direction file of each zone, empty for zones without one

  /// All of them, empty names left out.
  std::vector<std::filesystem::path> all() const;
};

JobInputs files_of(const Job& job);

/// Whether the job prints several parts, or copies of one.
bool is_plate(const Job& job);

/// The names of all models, part by part, to be changed.
std::vector<std::filesystem::path*> model_names(Job& job);

}  // namespace unicursal::host
