// The daemon's log: one line on standard error for each change of state, which systemd keeps in its journal.
#pragma once

#include <string>

namespace unicursal::host {

/// Writes one line, made printable. Never waits: a line that nobody takes is dropped, since the printer must
/// not wait for a reader.
void log_line(const std::string& text);

}  // namespace unicursal::host
