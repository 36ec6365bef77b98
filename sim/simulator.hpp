// A printer in a process of its own; `unicursal simulate` runs it. This header, simulator_options.hpp and
// sim/bed/raster.hpp are the whole interface between host and sim. Everything else goes over the serial line,
// the control socket and the report file.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "sim/simulator_options.hpp"

namespace unicursal::sim {

/// Throws std::invalid_argument for impossible options and std::system_error for an unreadable file.
void check(const SimulatorOptions& options);

/// The firmwares for SimulatorOptions::personality.
std::vector<std::string> personality_names();

/// The kinds of fault for SimulatorOptions::faults, one line each.
std::string fault_help();

/// Runs until SIGINT or SIGTERM (or, with options.once, until the host hangs up), then writes report and
/// pictures. Calls `ready` with the path of the pseudo-terminal when a host may open it, and again when the
/// cable comes back. Returns a process exit code. Throws std::system_error if the terminal or a file cannot
/// be made, and std::invalid_argument for impossible options; both before `ready`, unless the disk fills up.
int run_simulator(const SimulatorOptions& options, const std::function<void(const std::string&)>& ready);

}  // namespace unicursal::sim
