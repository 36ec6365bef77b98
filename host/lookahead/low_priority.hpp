// Threads that plan stand back behind the one that talks to the printer.
#pragma once

namespace unicursal::host {

/// Of the calling thread. Best effort: where it is refused, it just competes on equal terms.
void lower_priority();

}  // namespace unicursal::host
