#pragma once

namespace unicursal::host {

/// The greatest memory that this process has held, MiB (VmHWM of proc(5)); 0 if the system does not say.
double peak_memory();

}  // namespace unicursal::host
