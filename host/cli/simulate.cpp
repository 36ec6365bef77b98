#include <fmt/format.h>

#include <cstdio>

#include <stdexcept>
#include <system_error>

#include "core/error.hpp"
#include "host/cli/commands.hpp"
#include "host/cli/common.hpp"
#include "host/cli/show.hpp"
#include "host/job/profile.hpp"
#include "sim/simulator.hpp"

namespace unicursal::host {
namespace {

void follow(const Profile& profile, sim::SimulatorOptions& options) {
  const gcode::Printer& printer = profile.printer;
  options.baud = profile.baud;
  options.bed.assign(printer.bed.begin(), printer.bed.end());
  options.filament_diameter = printer.filament_diameter;
  options.max_acceleration.assign(printer.max_acceleration.begin(), printer.max_acceleration.end());
  options.max_speed.assign(printer.max_speed.begin(), printer.max_speed.end());
  const gcode::Motion& motion = printer.motion;
  options.jerk.assign(motion.jerk.begin(), motion.jerk.end());
  options.junction_deviation = motion.junction_deviation;
  options.acceleration = motion.acceleration;
  options.feeder_speed = motion.extruder_speed;
  options.feeder_acceleration = motion.extruder_acceleration;
  options.feeder_jerk = motion.extruder_jerk;
  options.dead_volume = printer.dead_volume;
  options.mixing_volume = printer.mixing_volume;
  if (!options.tanks) options.tanks = printer.tanks;
  options.feeders = static_cast<std::size_t>(printer.feeders);
}

}  // namespace

void check_simulator(const sim::SimulatorOptions& options) {
  constexpr auto remedy = "unicursal simulate --help tells what there is";
  try {
    sim::check(options);
  } catch (const std::invalid_argument& error) {
    throw core::DataError("", "", error.what(), remedy);
  } catch (const std::system_error& error) {
    throw core::DataError("", "", error.what(), "check its name and its permissions");
  }
}

Exit simulate(SimulateCommand command) {
  if (command.profile) {
    const Profile profile = load_profile(*command.profile);
    follow(profile, command.options);
    if (!command.personality_chosen) command.options.personality = profile.printer.firmware;
  }
  if (command.baud) command.options.baud = *command.baud;
  check_simulator(command.options);
  const sim::SimulatorOptions& options = command.options;
  check_outputs(present({command.profile, options.fault_file}),
                present({options.report, options.transcript, options.rasters}));
  const int code = sim::run_simulator(command.options, [](const std::string& port) {
    show(stdout, "{}\n", port);
    std::fflush(stdout);
  });
  return code == 0 ? Exit::success : Exit::failed;
}

}  // namespace unicursal::host
