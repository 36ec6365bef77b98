// The keys of a job's [part] that turn, mirror and scale its files.
#pragma once

#include "core/model/part.hpp"
#include "core/model/pose.hpp"
#include "host/job/settings_file.hpp"

namespace unicursal::host {

/// Reads units, scale, mirror, lie_on, rotate and width. They act in this order; turns are about x, then y,
/// then z. Precondition: `source.files` has been read. Throws JobError.
core::Pose read_pose(const Section& part, const core::PartSource& source);

}  // namespace unicursal::host
