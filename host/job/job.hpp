// A job: which part to print, how, and on what printer, as written in a TOML file.
// Lengths in mm, flow in mm³/s, angles in the file in degrees, in memory in radians.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/model/part.hpp"
#include "firmware_gcode/print/print_settings.hpp"
#include "host/job/profile.hpp"

namespace unicursal::host {

/// A mistake in a job or a profile; names file, line and key.
class JobError : public core::DataError {
 public:
  using DataError::DataError;
};

/// Where the part goes on the bed.
struct Placement {
  enum class Kind { center, as_is, at };
  Kind kind = Kind::center;
  core::Vec2 point{0, 0};  ///< on the bed, where the centre of the part's extent goes, for Kind::at
};

struct Job {
  std::filesystem::path file;
  core::PartSource source;  ///< zones name materials by index
  double bead_width = 0;
  std::optional<double> seed_distance;
  int perimeters = 0;  ///< contours around the fill
  double flow = 2;
  bool automatic_flow = false;
  std::optional<double> speed;   ///< mm/s, constant instead of the flow
  double first_layer_speed = 1;  ///< of the others'
  gcode::Skirt skirt;
  gcode::Fan fan;
  std::vector<gcode::LayerTemperature> temperatures;
  std::optional<double> line_width;  ///< of a thin line that shows the curve; absent: beads fill their area
  Placement place;
  gcode::Seam seam = gcode::Seam::hidden;
  double change_before_border = 0.5;  ///< share of every change of mixture
  // Only on the command line's word.
  bool look_ahead = true;     ///< of the mixing schedule; false for comparison
  bool full_quality = false;  ///< planning never hurries, though the nozzle may have to wait
  /// The mixtures that zones use, equal ones once, in order of first use.
  std::vector<gcode::Material> materials;
  Profile profile;
  std::vector<std::string> warnings;  ///< keys that are accepted but not followed yet, one sentence each
};

}  // namespace unicursal::host
