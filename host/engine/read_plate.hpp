// The parts and copies of a job on one plate: read, arranged on the bed, and put in order. mm.
//
// Parts that are printed one by one stand so far apart that the head, while it prints one, strikes none that
// is finished: farther than the profile's clearance_radius, and none but the last is higher than its
// clearance_height. The rule is that of "complete individual objects" in PrusaSlicer, with rectangles for
// hulls.
#pragma once

#include <memory>

#include "core/model/part.hpp"
#include "host/job/job.hpp"

namespace unicursal::host {

/// Precondition: is_plate(job). Throws core::DataError, for example if the parts do not fit, if a zone
/// matches nothing, or if the head would strike a part.
std::unique_ptr<const core::Part> read_plate(const Job& job);

}  // namespace unicursal::host
