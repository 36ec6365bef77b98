#include "host/cli/arguments.hpp"
#include "sim/simulator.hpp"

#include <fmt/format.h>

#include <limits>

namespace unicursal::host {

std::optional<std::filesystem::path> path_if(const std::string& text) {
  return text.empty() ? std::nullopt : std::optional<std::filesystem::path>(text);
}

std::optional<std::string> text_if(const std::string& text) {
  return text.empty() ? std::nullopt : std::optional(text);
}

CLI::Validator finite_number(double least, double most) {
  const auto problem = [least, most](const std::string& text) {
    double value = 0;
    const bool sound = CLI::detail::lexical_cast(text, value) && value >= least && value <= most;
    if (sound) return std::string();
    if (value < least || most == std::numeric_limits<double>::max())
      return fmt::format("\"{}\" is no number from {:g} up", text, least);
    return fmt::format("\"{}\" is no number from {:g} to {:g}", text, least, most);
  };
  return {problem, "NUMBER"};
}

void JobArguments::declare(CLI::App& app) {
  app.add_option("job", job, "the job, a TOML file")->required()->type_name("JOB");
  app.add_option("--profile", profile, "printer profile instead of the one that the job names")
      ->type_name("FILE");
  app.add_option("--layers", layers, "only these, first:last counted from 0, lowered onto the bed")
      ->type_name("A:B");
  app.add_option("--report", report, "write what was measured as JSON")->type_name("FILE");
  app.add_option("--picture", pictures, "write a picture of each layer into this folder")->type_name("DIR");
  app.add_flag("--no-look-ahead", no_look_ahead,
               "switch mixtures where the border is, not ahead of it: for comparison");
  app.add_option("--threads", threads,
                 "that plan layers; one for each core by default, any number gives the same bytes")
      ->check(finite_number(1, most_threads))
      ->type_name("N");
}

void JobArguments::declare_full_quality(CLI::App& app) {
  app.add_flag("--full-quality", full_quality,
               "plan every layer as well as it can be, though the nozzle may have to wait; "
               "otherwise quality steps down before it does");
}

JobOptions JobArguments::options() const {
  JobOptions result{job,     path_if(profile), {},          {path_if(report), path_if(pictures)},
                    threads, !no_look_ahead,   full_quality};
  if (!layers.empty()) result.layers = parse_layers(layers);
  return result;
}

namespace {

void declare_tanks(CLI::App& app, std::size_t& tanks) {
  app.add_option("--tanks", tanks,
                 "stirred tanks in a row that the nozzle mixes in, 1 to 8; the profile's, or 2")
      ->check(CLI::Range(1, 8))
      ->type_name("NUMBER");
}

}  // namespace

void PrinterArguments::declare(CLI::App& app) {
  app.add_option("--personality", personality,
                 "its firmware: marlin, marlin-8bit, marlin-advanced-ok, repetier; "
                 "that of the profile if left out")
      ->type_name("NAME");
  app.add_option("--usb", usb, "the chip in its cable: none, cdc (1 ms) or ftdi (16 ms)")->type_name("CHIP");
  app.add_option("--fault", faults, "what shall go wrong, see below; may be given several times")
      ->type_name("FAULT")
      ->take_all()
      ->expected(1);
  app.add_option("--faults", fault_file, "a file with one fault on each line, and perhaps `seed NUMBER`")
      ->type_name("FILE");
  declare_tanks(app, tanks);
  (seed_given[0] ? seed_given[1] : seed_given[0]) =
      app.add_option("--seed", seed, "of the faults' chance; the same seed gives the same faults")
          ->type_name("NUMBER");
}

void PrinterArguments::apply(sim::SimulatorOptions& options) const {
  if (chosen()) options.personality = personality;
  options.usb = usb;
  options.faults = faults;
  options.fault_file = path_if(fault_file);
  if (tanks > 0) options.tanks = tanks;
  for (const CLI::Option* given : seed_given) {
    if (given && given->count() > 0) options.seed = seed;
  }
}

std::string fault_footer() {
  return "A fault is KIND[:VALUE][@MOMENT]. A CHANCE is for each byte or line that passes, as in "
         "bitflip:1e-4;\n"
         "a MOMENT is t=SECONDS, line=NUMBER or command=WORD, as in stall:5@t=60. The kinds:\n" +
         sim::fault_help();
}

void TuneArguments::declare(CLI::App& parent) {
  app = parent.add_subcommand("transition", "find dead and mixing volume, and write them into the profile");
  declare_strip();
  declare_ways();
  declare_reading();
  app->footer(
      "Examples:\n  unicursal tune transition diamond.toml --port auto\n"
      "  unicursal tune transition diamond.toml -o strip.gcode      print that, then:\n"
      "  unicursal tune transition diamond.toml --began 31 --half 45 --stopped 73\n\n"
      "The strip is one bead in which the mixture changes at tick 0. Three lines below it show how it "
      "looks\n"
      "when 5, 50 and 95 % of the change have come: the questions are where the bead looks like them. The\n"
      "profile changes only when you say yes, and then only its two numbers. Two strong colours are read "
      "best;\n"
      "in a dark one a trace of a light one can hardly be seen.");
}

void TuneArguments::declare_strip() {
  app->add_option("profile", profile, "the printer's profile, a TOML file")->required()->type_name("PROFILE");
  app->add_option("--from", from, "feeder of the first colour, counted from 1")->check(CLI::Range(1, 3));
  app->add_option("--to", to, "feeder that it changes to")->check(CLI::Range(1, 3));
  app->add_option("--range", command.range,
                  "mm³ of transition that the strip can show; 60, or as much as the bed holds, if left out")
      ->check(finite_number(1, 1000))
      ->type_name("MM3");
}

void TuneArguments::declare_ways() {
  CLI::Option* port_option =
      app->add_option("--port", port, "print it: serial port, or auto")->type_name("PORT");
  app->add_option("-o,--output", output, "write it as a G-code file")->type_name("FILE");
  CLI::Option* simulate = app->add_flag("--simulate", command.simulate, "print it on the simulated printer");
  simulate->excludes(port_option);
  app->add_option("--machine", machine, "profile with the simulated printer's true volumes")
      ->needs(simulate)
      ->type_name("FILE");
  declare_tanks(*app, command.tanks);
  app->add_option("--picture", pictures,
                  "folder for the picture of the simulated strip; transition-strip if left out")
      ->needs(simulate)
      ->type_name("DIR");
  app->add_flag("--read-simulated", command.read_simulated, "read the simulated strip instead of asking")
      ->needs(simulate);
}

void TuneArguments::declare_reading() {
  const auto tick = finite_number(0, 1e6);
  CLI::Option* began = app->add_option("--began", command.began, "tick where the bead looks like the line 5")
                           ->check(tick)
                           ->type_name("TICK");
  CLI::Option* stopped = app->add_option("--stopped", command.stopped, "tick where it looks like the line 95")
                             ->check(tick)
                             ->type_name("TICK");
  app->add_option("--half", command.half, "tick where it looks like the line 50; makes the result finer")
      ->check(tick)
      ->needs(began)
      ->type_name("TICK");
  began->needs(stopped);
  stopped->needs(began);
  app->add_flag("--yes", command.yes, "write into the profile without asking");
}

TuneCommand TuneArguments::finished() const {
  TuneCommand result = command;
  result.profile = profile;
  result.feeders = {from - 1, to - 1};
  result.output = path_if(output);
  if (!port.empty()) result.port = port;
  result.machine = path_if(machine);
  result.pictures = path_if(pictures);
  return result;
}

}  // namespace unicursal::host
