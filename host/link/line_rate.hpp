// Serial lines at any rate. The C library's termios knows rates by name only, 250 000 not among them; the
// kernel's own structure, whose header cannot be included beside the library's, takes a number.
#pragma once

namespace unicursal::host {

/// bits/s; without effect where the driver cannot.
void set_line_rate(int descriptor, unsigned baud);
/// What the driver believes; 0 when it is no terminal.
unsigned line_rate(int descriptor);

}  // namespace unicursal::host
