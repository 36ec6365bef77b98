// A printer in a process of its own: what `unicursal simulate` runs. This header, with its options, is the
// whole seam between host and sim; everything else goes over the serial line and the report file.
#pragma once

#include <functional>
#include <string>

#include "sim/simulator_options.hpp"

namespace unicursal::sim {

/// Throws std::invalid_argument for options that make no printer, std::system_error for an unreadable file.
void check(const SimulatorOptions& options);

/// What `faults` may hold, one line for each kind.
std::string fault_help();

/// Runs until SIGINT/SIGTERM (or, with `once`, until the host hangs up) and writes report and pictures.
/// `ready` is called once with the path of the pseudo-terminal when a host may open it.
/// Returns a process exit code. Throws std::system_error when the terminal or a file cannot be made, and
/// std::invalid_argument for options that make no printer; both before `ready`, except when the disk fills
/// up.
int run_simulator(const SimulatorOptions& options, const std::function<void(const std::string&)>& ready);

}  // namespace unicursal::sim
