// The last resort of a serial cable: most boards are wired so that a pulse on DTR resets them, which switches
// heaters and motors off. Boards with USB of their own ignore it, and a pseudo-terminal has no such wire.
#pragma once

namespace unicursal::host {

/// Pulls DTR down and up again; blocks for 0.1 s. Returns false if the port has no such wire. True does not
/// mean that the board has reset.
bool pulse_reset(int port);

}  // namespace unicursal::host
