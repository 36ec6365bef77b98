#include <fmt/format.h>

#include <cstdio>

#include "host/cli/arguments.hpp"
#include "host/cli/command.hpp"
#include "host/cli/preparation.hpp"
#include "host/cli/terminal_output.hpp"
#include "host/job/profile.hpp"
#include "sim/simulator.hpp"

namespace unicursal::host {
namespace {

/// Makes the simulated printer the one that the profile describes.
void follow(const Profile& profile, sim::SimulatorOptions& options) {
  const gcode::Printer& printer = profile.printer;
  options.baud = profile.baud;
  options.bed.assign(printer.bed.begin(), printer.bed.end());
  options.overtravel.assign(printer.overtravel.begin(), printer.overtravel.end());
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
  if (profile.clearance) options.clearance = {profile.clearance->radius, profile.clearance->height};
  options.feeders = printer.feeders;
  for (const Filament& filament : profile.filaments.of_feeders) options.filaments.push_back(filament.colour);
}

class Simulate final : public Command {
 public:
  CLI::App& declare(CLI::App& program) override;
  Exit run() override;

 private:
  SimulatedPrinter printer_;
  std::optional<std::filesystem::path> profile_;
  std::optional<double> baud_;
  std::optional<std::size_t> feeders_;
};

CLI::App& Simulate::declare(CLI::App& program) {
  CLI::App& app = add_command(program, "simulate", "Try without a printer",
                              "Run a simulated printer that any host program can connect to.",
                              "unicursal simulate --link printer --speed 10 --report seen.json");
  add_note(app,
           "The program prints the path of a pseudo-terminal. Pronterface, OctoPrint or `unicursal print` "
           "connect to that path, or to the link ./printer of the example, like to a serial port.");
  sim::SimulatorOptions& options = printer_.options;
  add_value(app, "--link", options.link, "PATH", "Make a symbolic link to the pseudo-terminal.");
  add_value(app, "--speed", options.speed, "FACTOR",
            "Printer seconds per second: 1 is real time. Default: 0, which executes every line at once.")
      .check(number_between(0, any_number));
  add_value(app, "--baud", baud_, "RATE",
            "Bits per second of the simulated line. Default: the profile's rate, or 250000.")
      .check(number_between(300, 1e8));
  app.add_flag("--once", options.once, "End after the first host has used the line and closed it.");
  add_value(app, "--control", options.control, "PATH",
            "Make a Unix socket through which the host advances printer time (sim/lockstep.hpp).");
  add_value(app, "--report", options.report, "FILE", "Write the printer's own report, as JSON, at the end.")
      .group("Output");
  add_value(app, "--picture", options.pictures, "DIR",
            "Write pictures of each layer, of the part and of the motion to this folder.")
      .group("Output");
  add_value(app, "--pixel", options.pixel, "MM", "Size of a pixel in these pictures. Default: 0.05.")
      .check(number_between(0.01, 10))
      ->group("Output");
  add_value(app, "--rasters", options.rasters, "FILE",
            "Write every deposited layer to this file or pipe (sim/bed/raster.hpp).")
      .group("Output");
  add_value(app, "--beads", options.beads, "FILE",
            "Write every bead that is laid to this file: times, ends, volume and shares of the feeders.")
      .group("Output");
  add_value(app, "--transcript", options.transcript, "FILE", "Write each command when it is executed.")
      .group("Output");
  add_value(app, "--profile", profile_, "PROFILE", "Simulate the printer that this profile describes.")
      .group("Simulated printer");
  add_value(app, "--feeders", feeders_, "N",
            "Number of feeders that meet in the nozzle, 1 to 8. Default: the profile's number, or 3.")
      .check(integer_between(1, 8))
      ->group("Simulated printer");
  printer_.declare(app);
  return app;
}

Exit Simulate::run() {
  sim::SimulatorOptions& options = printer_.options;
  if (printer_.personality) options.personality = *printer_.personality;
  if (profile_) {
    const Profile profile = load_profile(*profile_);
    follow(profile, options);
    if (!printer_.personality) options.personality = profile.printer.firmware;
  }
  if (baud_) options.baud = *baud_;
  if (feeders_) options.feeders = *feeders_;
  printer_.check();
  check_outputs(present({profile_, options.fault_file}),
                present({options.report, options.transcript, options.rasters, options.beads}));
  const int code = sim::run_simulator(options, [](const std::string& port) {
    show(stdout, "{}\n", port);
    std::fflush(stdout);
  });
  return code == 0 ? Exit::success : Exit::failed;
}

}  // namespace

std::unique_ptr<Command> make_simulate() {
  return std::make_unique<Simulate>();
}

}  // namespace unicursal::host
