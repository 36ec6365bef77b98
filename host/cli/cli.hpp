// The command line: `unicursal COMMAND …`.
#pragma once

namespace unicursal::host {

/// Parses the command line, runs the command and returns the exit code of the process (exit.hpp). Never
/// throws.
int run_command_line(int argc, char** argv);

}  // namespace unicursal::host
