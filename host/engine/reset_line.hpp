// The last resort of a serial cable: most boards are wired so that a pulse on DTR resets them, which switches
// heaters and motors off. Boards with USB of their own ignore it, and a pseudo-terminal has no such wire.
#pragma once

namespace unicursal::host {

/// Pulls DTR down and up again, blocking for a tenth of a second. False where the port has no such wire; true
/// tells nothing of what the board makes of it.
bool pulse_reset(int port);

}  // namespace unicursal::host
