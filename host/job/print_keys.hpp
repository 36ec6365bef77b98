// The keys of a job's [part] that do not concern its shape: speed, skirt, fan, temperatures.
#pragma once

#include "host/job/job.hpp"
#include "host/job/settings_file.hpp"

namespace unicursal::host {

/// Precondition: the profile and the flow have been read. Throws JobError.
void read_print_keys(const Section& part, Job& job);

}  // namespace unicursal::host
