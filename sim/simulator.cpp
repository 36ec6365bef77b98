#include "sim/simulator.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <fstream>
#include <stdexcept>
#include <system_error>

#include "sim/bed/bead_log.hpp"
#include "sim/bed/bead_pictures.hpp"
#include "sim/bed/deposit.hpp"
#include "sim/bed/raster.hpp"
#include "sim/lockstep.hpp"
#include "sim/motion/motion_log.hpp"
#include "sim/motion/motion_picture.hpp"
#include "sim/motion/move_sinks.hpp"
#include "sim/nozzle/feed_log.hpp"
#include "sim/nozzle/nozzle.hpp"
#include "sim/printer.hpp"
#include "sim/report.hpp"
#include "sim/session.hpp"

namespace unicursal::sim {

namespace {

void require(bool condition, const char* sentence) {
  if (!condition) throw std::invalid_argument(sentence);
}

bool positive(double value) {
  return std::isfinite(value) && value > 0;
}

bool three_positive(const std::vector<double>& values) {
  return values.size() == 3 && std::all_of(values.begin(), values.end(), positive);
}

Usb usb_named(const std::string& name) {
  if (name == "none") return Usb::none;
  if (name == "cdc") return Usb::cdc;
  if (name == "ftdi") return Usb::ftdi;
  throw std::invalid_argument("there is no USB chip \"" + name + "\"; use none, cdc or ftdi");
}

}  // namespace

void check(const SimulatorOptions& options) {
  require(three_positive(options.bed), "the bed needs three positive sizes: x, y and z in mm");
  require(options.overtravel.size() == 2 && options.overtravel[0] >= 0 && options.overtravel[1] >= 0,
          "the overtravel has two lengths that are not negative: x and y in mm");
  require(three_positive(options.steps_per_mm), "the axes need three positive numbers of steps per mm");
  require(three_positive(options.max_acceleration), "the axes need three positive accelerations in mm/s²");
  require(three_positive(options.max_speed), "the axes need three positive speeds in mm/s");
  require(three_positive(options.jerk), "the axes need three positive jerks in mm/s");
  require(positive(options.acceleration) && positive(options.feeder_speed) &&
              positive(options.feeder_acceleration) && positive(options.feeder_jerk),
          "accelerations, and the feeders' speed and jerk, are positive numbers");
  require(options.junction_deviation >= 0 && options.junction_deviation <= 1,
          "the junction deviation is 0 to 1 mm");
  require(positive(options.feeder_steps_per_mm), "the feeders need a positive number of steps per mm");
  require(positive(options.filament_diameter), "the filament needs a positive diameter in mm");
  require(positive(options.pixel), "a picture's pixel needs a positive size in mm");
  require(options.raster_pixel >= 0.01 && options.raster_pixel <= 1, "a raster's pixel is 0.01 to 1 mm wide");
  require(options.dead_volume >= 0 && options.dead_volume <= 1000 && options.mixing_volume >= 0 &&
              options.mixing_volume <= 1000,
          "the chamber's volumes are 0 to 1000 mm³");
  require(!options.tanks || (*options.tanks >= 1 && *options.tanks <= 8), "a chamber has one to eight tanks");
  require(std::isfinite(options.speed) && options.speed >= 0, "the clock's speed is 0 or a positive number");
  require(positive(options.baud), "the line needs a positive number of bits per second");
  require(!options.control || options.speed == 0, "with a control socket the host sets the clock's speed");
  usb_named(options.usb);
  const std::size_t most = personality(options.personality).most_feeders;
  if (options.feeders < 1 || options.feeders > most)
    throw std::invalid_argument(
        fmt::format("a printer with the personality {} has 1 to {} feeders", options.personality, most));
  for (const std::string& fault : options.faults) parse_fault(fault);
  if (options.fault_file) read_faults(*options.fault_file);
}

namespace {

Machine machine_for(const SimulatorOptions& options) {
  Machine machine;
  std::copy_n(options.bed.begin(), 3, machine.bed.begin());
  std::copy_n(options.overtravel.begin(), 2, machine.overtravel.begin());
  std::copy_n(options.steps_per_mm.begin(), 3, machine.limits.steps_per_mm.begin());
  std::copy_n(options.max_acceleration.begin(), 3, machine.limits.max_acceleration.begin());
  std::copy_n(options.max_speed.begin(), 3, machine.limits.max_speed.begin());
  MotionLimits& limits = machine.limits;
  std::copy_n(options.jerk.begin(), 3, limits.jerk.begin());
  limits.junction_deviation = options.junction_deviation;
  limits.print_acceleration = limits.travel_acceleration = options.acceleration;
  limits.max_speed[axis_e] = options.feeder_speed;
  limits.max_acceleration[axis_e] = options.feeder_acceleration;
  limits.jerk[axis_e] = options.feeder_jerk;
  limits.steps_per_mm[axis_e] = options.feeder_steps_per_mm;
  machine.feeders = options.feeders;
  return machine;
}

std::ofstream open_output(const std::optional<std::filesystem::path>& file) {
  if (!file) return {};
  errno = 0;
  std::ofstream report(*file);
  if (!report) throw std::system_error(errno, std::generic_category(), "cannot write " + file->string());
  return report;
}

WireModel wire_for(const SimulatorOptions& options) {
  const bool leaps = options.speed == 0 && !options.control;
  return leaps ? WireModel{} : WireModel{options.baud, usb_named(options.usb)};
}

FaultPlan plan_for(const SimulatorOptions& options) {
  FaultPlan plan;
  if (options.fault_file) plan = read_faults(*options.fault_file);
  for (const std::string& fault : options.faults) plan.faults.push_back(parse_fault(fault));
  if (options.seed) plan.seed = *options.seed;
  return plan;
}

void run_session(const SimulatorOptions& options, Printer& printer,
                 const std::function<void(const std::string&)>& ready) {
  if (options.control) {
    Lockstep(options, printer, ready).run();
  } else {
    Session(options, printer, ready).run();
  }
  printer.run_down();
}

}  // namespace

int run_simulator(const SimulatorOptions& options, const std::function<void(const std::string&)>& ready) {
  check(options);
  std::ofstream report = open_output(options.report), transcript = open_output(options.transcript);
  std::optional<BeadStore> pictures;
  if (options.pictures) {
    clear_pictures(*options.pictures);
    pictures.emplace(*options.pictures, picture::Filaments(options.filaments));
  }
  std::optional<RasterWriter> rasters;
  std::optional<Spread> spread;
  Strikes strikes(options.clearance
                      ? std::optional(HeadShape{options.clearance->first, options.clearance->second})
                      : std::nullopt);
  Deposit deposit({.drawing = pictures ? &*pictures : nullptr, .strikes = &strikes});
  if (options.rasters) {
    rasters.emplace(*options.rasters);
    spread.emplace(BedSize{options.bed[0], options.bed[1]}, options.raster_pixel, options.feeders);
    deposit = Deposit({pictures ? &*pictures : nullptr, &*spread, &*rasters, &strikes});
  }
  std::ofstream beads = open_output(options.beads);
  BeadLog bead_log(beads, options.feeders, deposit);
  Nozzle nozzle(
      options.filament_diameter,
      Chamber({options.dead_volume, options.mixing_volume, options.tanks.value_or(ChamberSize{}.tanks)},
              options.feeders),
      options.beads ? static_cast<BedSink&>(bead_log) : deposit);
  FeedLog feed;
  MotionLog motion(nozzle.filament_area());
  MoveSinks sinks({&feed, &nozzle, &motion});
  Printer printer(machine_for(options), personality(options.personality), wire_for(options),
                  plan_for(options), sinks);
  if (options.transcript)  // flushed at once, since somebody may be following it
    printer.watch_commands([&](const std::string& command) { transcript << command << std::endl; });
  run_session(options, printer, ready);
  deposit.finish();

  if (options.report) {
    Outcome outcome{feed, nozzle, deposit, motion, strikes};
    if (pictures) outcome.pictures = place_of_layers(*pictures, options.pixel);
    report << report_json(machine_for(options), printer, outcome) << '\n';
    report.close();
    if (!report)
      throw std::system_error(EIO, std::generic_category(), "cannot write " + options.report->string());
  }
  if (pictures) {
    draw_layers(*pictures, *options.pictures, options.pixel);
    draw_part(*pictures, *options.pictures);
    picture::write_png(*options.pictures / "motion.png", draw_motion(motion));
  }
  return 0;
}

}  // namespace unicursal::sim
