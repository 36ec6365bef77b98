// The zones of a job and the mixtures that they are printed in.
#pragma once

#include <string>
#include <vector>

#include "core/model/part.hpp"
#include "firmware_gcode/print/print_settings.hpp"
#include "host/job/profile.hpp"
#include "host/job/settings_file.hpp"

namespace unicursal::host {

struct ZonesAndMaterials {
  std::vector<core::Zone> zones;
  std::vector<gcode::Material> materials;
};

/// Reads [[zone]] and [mixture] of a job's root, for the feeders and filaments of the profile. `notes` gets a
/// sentence for each mixture that is given by its colour. A gradient without
/// `over` begins and ends at 0; prepare() (host/engine/prepared_job.hpp) then computes its ends. Throws
/// JobError.
ZonesAndMaterials read_zones(const Section& root, const Profile& profile, std::vector<std::string>& notes);

}  // namespace unicursal::host
