#include <fmt/format.h>

#include <cstdio>

#include "host/cli/commands.hpp"
#include "host/cli/show.hpp"
#include "host/job/profile.hpp"

namespace unicursal::host {
namespace {

void follow(const gcode::Printer& printer, sim::SimulatorOptions& options) {
  options.bed.assign(printer.bed.begin(), printer.bed.end());
  options.filament_diameter = printer.filament_diameter;
  options.max_acceleration.assign(printer.max_acceleration.begin(), printer.max_acceleration.end());
  options.dead_volume = printer.dead_volume;
  options.mixing_volume = printer.mixing_volume;
  options.feeders = static_cast<std::size_t>(printer.feeders);
}

}  // namespace

Exit simulate(SimulateCommand command) {
  if (command.profile) follow(load_profile(*command.profile).printer, command.options);
  const int code = sim::run_simulator(command.options, [](const std::string& port) {
    show(stdout, "{}\n", port);
    std::fflush(stdout);
  });
  return code == 0 ? Exit::success : Exit::failed;
}

}  // namespace unicursal::host
