#include <fmt/format.h>

#include <cmath>
#include <iostream>

#include "core/error.hpp"
#include "host/cli/arguments.hpp"
#include "host/cli/command.hpp"
#include "host/cli/photo_corners.hpp"
#include "host/cli/terminal_output.hpp"
#include "host/cli/test_printing.hpp"
#include "host/cli/tune_colours.hpp"
#include "host/cli/tune_flow.hpp"
#include "host/job/profile_edit.hpp"
#include "host/photo/read_photo.hpp"
#include "host/report/summary.hpp"
#include "host/tune/curve_fit.hpp"
#include "host/tune/fit_picture.hpp"
#include "host/tune/raster_reader.hpp"
#include "host/tune/strip_photo.hpp"
#include "host/tune/terminal_reader.hpp"

namespace unicursal::host {
namespace {

constexpr const char* usual_pictures = "transition-strip";
constexpr const char* strip_name = "the strip";

struct TuneOptions {
  std::filesystem::path profile;
  std::size_t from = 1, to = 2;                 ///< feeders, counted from 1
  std::optional<double> range;                  ///< mm³ of transition that the strip has room for
  std::optional<std::filesystem::path> output;  ///< G-code
  std::optional<std::string> port;
  bool simulate = false;
  std::optional<std::filesystem::path> machine;   ///< profile with the true volumes of the simulated printer
  std::optional<std::size_t> tanks;               ///< of the simulated nozzle
  std::optional<std::filesystem::path> pictures;  ///< folder
  std::optional<std::filesystem::path> rasters;   ///< the simulated strip as it was laid
  bool read_simulated = false;                    ///< read the raster instead of asking
  std::optional<double> began, half, stopped;     ///< ticks
  std::optional<std::filesystem::path> photo;
  std::optional<std::string> corners;  ///< of the photo, pixels
  bool yes = false;                    ///< write without asking

  StripFeeders feeders() const { return {from - 1, to - 1}; }
};

/// Returns the ticks that were given on the command line.
class GivenReader final : public StripReader {
 public:
  explicit GivenReader(const TuneOptions& command) : command_(command) {}

  StripReading read(const Strip& strip) override {
    StripReading reading{*command_.began * strip.tick, *command_.stopped * strip.tick, {}};
    if (command_.half) reading.half = *command_.half * strip.tick;
    return reading;
  }

 private:
  const TuneOptions& command_;
};

void check_feeders(const TuneOptions& command, const Profile& profile) {
  const auto feeders = profile.printer.feeders;
  for (const auto& [option, feeder] :
       {std::pair{"--from", command.feeders().from}, std::pair{"--to", command.feeders().to}}) {
    if (feeder < feeders) continue;
    throw core::DataError("", option, fmt::format("this printer has no feeder {}", feeder + 1),
                          fmt::format("choose one of 1 to {}", feeders));
  }
  if (command.feeders().from != command.feeders().to) return;
  throw core::DataError("", "--to", "is the same feeder as --from",
                        "choose two feeders of different colours");
}

/// Pictures are made by default only if a person will read them.
std::optional<std::filesystem::path> pictures_of(const TuneOptions& command) {
  if (command.pictures || command.read_simulated || command.began) return command.pictures;
  return usual_pictures;
}

std::unique_ptr<StripOnRaster> print_simulated(const TuneOptions& command, const Profile& profile,
                                               const Strip& strip, const FinishedPrint& print) {
  auto seen = std::make_unique<StripOnRaster>(strip, strip_mixtures(profile.printer, command.feeders()));
  const SimulatedTest simulated{command.machine.value_or(command.profile), command.tanks,
                                pictures_of(command), command.rasters};
  simulate_test(
      simulated, profile, print, strip_name,
      [&](const sim::RasterFrame& frame, sim::RasterReader& rasters) { seen->take(frame, rasters); });
  return seen;
}

std::unique_ptr<StripReader> reader_for(const TuneOptions& command, std::unique_ptr<StripReader> simulated) {
  if (command.began) return std::make_unique<GivenReader>(command);
  if (command.read_simulated) return simulated;
  return std::make_unique<TerminalReader>(std::cin, std::cout);
}

void report(const Strip& strip, const FinishedPrint& print) {
  const auto [volume, seconds] = amount_of(print);
  show(stdout,
       "strip:     {} ticks of {:g} mm in {} lane{}, shows a transition of up to {:.0f} mm³; {:.0f} mm³ and "
       "about {} in all\n",
       strip.points.size() - 1, strip.tick, strip.lanes, strip.lanes == 1 ? "" : "s", strip.volume(), volume,
       duration_words(seconds));
}

void report(const Strip& strip, const StripReading& reading) {
  const auto tick = [&](double along) { return along / strip.tick; };
  show(stdout, "read:      began at tick {:g},{} stopped at tick {:g}\n", tick(reading.began),
       reading.half ? fmt::format(" half changed at {:g},", tick(*reading.half)) : "", tick(reading.stopped));
}

void report(const Transition& found, const gcode::Printer& printer) {
  const auto line = [](const char* name, const Estimate& estimate, double before) {
    show(stdout, "{}{:.2f} mm³, give or take {:.2f} (the profile says {:g})\n", name, estimate.value,
         estimate.uncertainty, before);
  };
  line("dead:      ", found.dead, printer.dead_volume);
  line("mixing:    ", found.mixing, printer.mixing_volume);
  if (found.widened > 1) {
    show(stdout,
         "No nozzle fits these readings to the tick. Reading the strip again may give better numbers.\n");
  }
}

void report(const CurveFit& found, const gcode::Printer& printer) {
  const auto line = [](const char* name, const Estimate& estimate, const char* unit, double before) {
    show(stdout, "{}{:.2f}{}, give or take {:.2f} (the profile says {:g})\n", name, estimate.value, unit,
         estimate.uncertainty, before);
  };
  line("dead:      ", found.dead, " mm³", printer.dead_volume);
  line("mixing:    ", found.mixing, " mm³", printer.mixing_volume);
  line("tanks:     ", found.tanks, "", static_cast<double>(printer.tanks));
}

void confirm(const TuneOptions& command, const std::string& what) {
  const std::string question = fmt::format("Write {} into {}?", what, command.profile.string());
  if (!command.yes && !confirmed(std::cin, std::cout, question))
    throw TuningCancelled("the result was not accepted");
}

std::filesystem::path fit_file(const TuneOptions& command) {
  return *command.pictures / "fit.png";
}

void settle_from_photo(const TuneOptions& command, const ProfileText& text, const Profile& profile,
                       const Strip& strip) {
  const std::filesystem::path& file = *command.photo;
  const std::optional<GivenCorners> corners = corners_in(command.corners);
  const Photo photo = read_photo(file);
  const Sheet sheet(photo, sheet_plan(strip), corners, file);
  const StripCurve curve = read_curve(sheet, strip, file);
  const CurveFit found = fit_curve(curve.points, curve.switches, curve.references, file);
  report(found, profile.printer);
  if (command.pictures) {
    std::filesystem::create_directories(*command.pictures);
    picture::write_png(fit_file(command), fit_picture(photo, sheet, strip, curve, found));
    show(stdout, "picture:   {}\n", fit_file(command).string());
  }
  const auto tanks = static_cast<std::size_t>(std::lround(found.tanks.value));
  confirm(command, fmt::format("both volumes and {} tank{}", tanks, tanks == 1 ? "" : "s"));
  text.set_transition({found.dead.value, found.mixing.value, tanks});
  show(stdout, "written:   {}\n", command.profile.string());
}

void settle(const TuneOptions& command, const ProfileText& text, const Profile& profile, const Strip& strip,
            StripReader& reader) {
  const StripReading reading = reader.read(strip);
  report(strip, reading);
  const Transition found = fit_transition(volumes_of(strip, reading));
  report(found, profile.printer);
  confirm(command, "both");
  text.set_transition({found.dead.value, found.mixing.value, {}});
  show(stdout, "written:   {}\n", command.profile.string());
}

Exit tune_transition(const TuneOptions& command) {
  const Profile profile = load_profile(command.profile);
  const ProfileText text(command.profile);
  check_feeders(command, profile);
  const std::vector<std::optional<std::filesystem::path>> inputs{command.profile, command.machine,
                                                                 command.photo};
  expect_other_file(command.output, inputs);
  expect_other_file(command.rasters, inputs);
  if (command.photo && command.pictures) expect_other_file(fit_file(command), inputs);
  corners_in(command.corners);
  const Strip strip = make_strip(profile.printer, command.range);
  const FinishedPrint print = strip_print(strip, profile.printer, command.feeders());
  report(strip, print);
  try {
    if (command.output) write_gcode(print, *command.output);
    std::unique_ptr<StripReader> simulated;
    if (command.simulate) simulated = print_simulated(command, profile, strip, print);
    if (command.port) print_test(*command.port, profile, print, strip_name);
    const bool printed = command.simulate || command.port;
    if (command.output && !printed && !command.began && !command.photo) {
      show(stdout, "Print this file, then run the command again without -o to enter what the strip shows.\n");
      return Exit::success;
    }
    if (command.photo) {
      settle_from_photo(command, text, profile, strip);
    } else {
      settle(command, text, profile, strip, *reader_for(command, std::move(simulated)));
    }
    return Exit::success;
  } catch (const TuningCancelled& cancelled) {
    show(stdout, "{}; the profile was not changed\n", cancelled.what());
    return Exit::failed;
  }
}

class Tune final : public Command {
 public:
  CLI::App& declare(CLI::App& program) override;
  Exit run() override {
    if (colours_.chosen()) return colours_.run();
    return flow_.chosen() ? flow_.run() : tune_transition(options_);
  }

 private:
  void declare_strip(CLI::App& app);
  void declare_printing(CLI::App& app);
  void declare_reading(CLI::App& app);

  TuneOptions options_;
  TuneColours colours_;
  TuneFlow flow_;
};

CLI::App& Tune::declare(CLI::App& program) {
  CLI::App& tune = add_command(program, "tune", "Print", "Calibrate a profile with a test print.",
                               "unicursal tune transition diamond.toml --port auto");
  tune.require_subcommand(1);
  CLI::App* app = tune.add_subcommand(
      "transition", "Measure dead and mixing volume with a test strip and write them to the profile.");
  app->footer(
      "Examples:\n  unicursal tune transition diamond.toml --port auto\n"
      "  unicursal tune transition diamond.toml -o strip.gcode      print this file, then:\n"
      "  unicursal tune transition diamond.toml --photo strip.jpg\n"
      "  unicursal tune transition diamond.toml --began 31 --half 45 --stopped 73");
  add_note(*app,
           "The strip is one bead whose mixture changes at tick 0. Lines below it show the colour after 5, "
           "50, 95 and "
           "100 % of the change. The program reads the strip from a photo, or asks at which ticks the bead "
           "looks like these "
           "lines. It changes only dead_volume, mixing_volume and, from a photo, tanks of the profile, and "
           "only after you "
           "confirm. Use two strong colours: a trace of a light colour can hardly be seen in a dark one.");
  declare_strip(*app);
  declare_printing(*app);
  declare_reading(*app);
  colours_.declare(tune);
  flow_.declare(tune);
  return tune;
}

void Tune::declare_strip(CLI::App& app) {
  constexpr auto group = "Strip";
  add_value(app, "PROFILE", options_.profile, " ", "The printer's profile: see unicursal-profile(5).")
      .required();
  add_value(app, "--from", options_.from, "FEEDER", "Feeder of the first colour, counted from 1. Default: 1.")
      .check(integer_between(1, 8))
      ->group(group);
  add_value(app, "--to", options_.to, "FEEDER", "Feeder of the second colour. Default: 2.")
      .check(integer_between(1, 8))
      ->group(group);
  add_value(app, "--range", options_.range, "MM3",
            "Volume of transition that the strip has room for, mm³. Default: 60, or less on a small bed.")
      .check(number_between(1, 1000))
      ->group(group);
}

void Tune::declare_printing(CLI::App& app) {
  constexpr auto group = "Printing";
  CLI::Option& port = add_value(app, "--port", options_.port, "PORT",
                                "Print the strip on this serial port, or auto to search for the printer.");
  port.group(group);
  add_value(app, "-o,--output", options_.output, "FILE", "Write the strip to this file, as G-code.")
      .group(group);
  CLI::Option* simulate =
      app.add_flag("--simulate", options_.simulate, "Print the strip on the simulated printer.")
          ->excludes(&port);
  simulate->option_text(" ")->group(group);
  add_value(app, "--machine", options_.machine, "PROFILE",
            "Profile with the true volumes of the simulated printer. Needs --simulate.")
      .needs(simulate)
      ->group("Simulated printer");
  declare_tanks(app, options_.tanks);
  add_value(app, "--picture", options_.pictures, "DIR",
            "Folder for pictures: of the simulated strip, and of the photo with the fit. Default: "
            "transition-strip for the former, unless it is read with --read-simulated or --began.")
      .group("Pictures");
  add_value(app, "--rasters", options_.rasters, "FILE",
            "Keep what the simulated printer has laid in this file (sim/bed/raster.hpp). Needs --simulate.")
      .needs(simulate)
      ->group("Simulated printer");
}

void Tune::declare_reading(CLI::App& app) {
  constexpr auto group = "Reading";
  const auto tick = [&](const char* name, std::optional<double>& value, const char* help) {
    CLI::Option* option = add_value(app, name, value, "TICK", help).check(number_between(0, 1e6));
    return option->group(group);
  };
  CLI::Option* began =
      tick("--began", options_.began, "Tick where the bead looks like line 5. Needs --stopped.");
  CLI::Option* stopped =
      tick("--stopped", options_.stopped, "Tick where the bead looks like line 95. Needs --began.");
  tick("--half", options_.half, "Tick where the bead looks like line 50, for a finer result. Needs --began.")
      ->needs(began);
  began->needs(stopped);
  stopped->needs(began);
  CLI::Option* photo = add_value(app, "--photo", options_.photo, "FILE",
                                 "Read the strip from this photo, JPEG or PNG. It shows all six round marks, "
                                 "sharp and in even light.")
                           .group(group);
  for (CLI::Option* other : {began, app.get_option("--port"), app.get_option("--simulate")})
    photo->excludes(other);
  add_value(
      app, "--corners", options_.corners, "NUMBERS",
      "Where the four corner marks are in the photo, if they are not found: x,y of the front left, front "
      "right, back right and back left one, in pixels. Needs --photo.")
      .needs(photo)
      ->group(group);
  app.add_flag("--read-simulated", options_.read_simulated,
               "Measure the simulated strip instead of asking. Needs --simulate.")
      ->needs(app.get_option("--simulate"))
      ->option_text(" ")
      ->group(group);
  app.add_flag("--yes", options_.yes, "Write to the profile without asking.")->group(group);
}

}  // namespace

std::unique_ptr<Command> make_tune() {
  return std::make_unique<Tune>();
}

}  // namespace unicursal::host
