// The command line: `unicursal COMMAND …`.
#pragma once

namespace unicursal::host {

/// Exit codes, for scripts.
enum class Exit : int {
  success = 0,
  failed = 1,     ///< the print, the simulation or the report of one did not end well
  bad_input = 2,  ///< a file, a key or an option; nothing was sent to a printer
  stopped = 3,    ///< the user has ended the print before its time
};

/// Parses, runs and returns the process's exit code. Never throws.
int run_command_line(int argc, char** argv);

}  // namespace unicursal::host
