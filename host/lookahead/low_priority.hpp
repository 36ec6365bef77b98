// Planning threads have a lower priority than the thread that talks to the printer.
#pragma once

namespace unicursal::host {

/// Lowers the priority of the calling thread. Best effort: if the system refuses, the priority stays as it
/// is.
void lower_priority();

}  // namespace unicursal::host
