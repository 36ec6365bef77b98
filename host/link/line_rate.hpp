// Serial lines at any rate. The C library's termios has named rates only, without 250 000; the kernel's own
// structure takes a number. Its header cannot be included together with the library's, hence this file.
#pragma once

namespace unicursal::host {

/// Sets the rate in bits/s; without effect if the driver does not support it.
void set_line_rate(int descriptor, unsigned baud);
/// Returns the driver's rate in bits/s; 0 if the descriptor is not a terminal.
unsigned line_rate(int descriptor);

}  // namespace unicursal::host
