#include "host/cli/arguments.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <sstream>
#include <stdexcept>
#include <system_error>

#include "core/error.hpp"
#include "host/cli/help_format.hpp"
#include "host/cli/terminal_output.hpp"
#include "sim/simulator.hpp"

namespace unicursal::host {
namespace {

std::size_t parse_index(std::string_view text, const std::string& whole) {
  std::size_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc() && end == text.data() + text.size()) return value;
  throw core::DataError("", "--layers", fmt::format("\"{}\" is not a range of layers", whole),
                        "write first:last counted from 0, for example 0:4");
}

/// Ends like --help does.
void show_faults() {
  std::string text = help_paragraph(
      "A fault is KIND[:VALUE][@MOMENT]. A CHANCE is the probability for each byte or line, as in "
      "bitflip:1e-4. A MOMENT is t=SECONDS, line=NUMBER or command=WORD, as in stall:5@t=60. The kinds are:");
  std::istringstream lines(sim::fault_help());
  for (std::string line; std::getline(lines, line);) {
    const std::size_t name = line.find_first_not_of(' '), name_end = line.find("  ", name);
    const std::size_t description = line.find_first_not_of(' ', name_end);
    if (description == std::string::npos) continue;
    text += help_entry(line.substr(name, name_end - name), line.substr(description));
  }
  show(stdout, "{}", text);
  throw CLI::Success();
}

/// Validators without a name do not show in the help.
CLI::Validator validator(std::function<std::string(std::string&)> problem) {
  return {std::move(problem), ""};
}

}  // namespace

CLI::Validator number_between(double least, double most) {
  return validator([least, most](const std::string& text) {
    double value = 0;
    if (CLI::detail::lexical_cast(text, value) && value >= least && value <= most) return std::string();
    if (most == any_number) return fmt::format("\"{}\" is not a number from {:g} up", text, least);
    return fmt::format("\"{}\" is not a number from {:g} to {:g}", text, least, most);
  });
}

CLI::Validator integer_between(std::uint64_t least, std::uint64_t most) {
  return validator([least, most](const std::string& text) {
    std::uint64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool whole = error == std::errc() && end == text.data() + text.size();
    if (whole && value >= least && value <= most) return std::string();
    if (most == std::numeric_limits<std::uint64_t>::max())
      return fmt::format("\"{}\" is not a whole number from {} up", text, least);
    return fmt::format("\"{}\" is not a whole number from {} to {}", text, least, most);
  });
}

CLI::Validator one_of(const std::vector<std::string>& words) {
  return validator([words](const std::string& text) {
    if (std::find(words.begin(), words.end(), text) != words.end()) return std::string();
    return fmt::format("\"{}\" is not one of {}", text, fmt::join(words, ", "));
  });
}

CLI::Validator not_empty() {
  return validator([](const std::string& text) { return text.empty() ? "the value is empty" : ""; });
}

CLI::App& add_command(CLI::App& program, const std::string& name, const std::string& group,
                      const std::string& summary, const std::string& example) {
  CLI::App* app = program.add_subcommand(name, summary);
  app->group(group);
  app->footer("Example:\n  " + example);
  return *app;
}

void add_note(CLI::App& app, const std::string& paragraph) {
  app.footer(app.get_footer() + "\n\n" + paragraph);
}

LayerRange parse_layers(const std::string& text) {
  const std::size_t colon = text.find(':');
  const std::string_view view = text;
  LayerRange range;
  if (colon == std::string::npos) {
    range.first = range.last = parse_index(view, text);
    return range;
  }
  range.last = static_cast<std::size_t>(-1) / 2;
  if (colon > 0) range.first = parse_index(view.substr(0, colon), text);
  if (colon + 1 < text.size()) range.last = parse_index(view.substr(colon + 1), text);
  return range;
}

void JobOptions::declare(CLI::App& app) {
  add_value(app, "JOB", job, " ",
            "The job, a TOML file (see unicursal-job(5)), or a model: .svg, .stl, .3mf, .obj or .amf.")
      .required();
  add_value(app, "--profile", profile, "PROFILE",
            "Use this printer profile instead of the one that the job names.")
      .group("Job");
  declare_layers(app, layers,
                 "Print only the layers A to B, counted from 0 with both included. They are moved down onto "
                 "the bed.");
  add_value(app, "--report", outputs.report, "FILE", "Write all measurements to this file, as JSON.")
      .group("Output");
  add_value(app, "--picture", outputs.pictures, "DIR", "Write pictures of each layer to this folder.")
      .group("Output");
  declare_quiet(app, quiet);
  app.add_flag_callback(
         "--no-look-ahead", [this] { look_ahead = false; },
         "Switch mixtures at the borders instead of ahead of them, for comparison.")
      ->group("Planning");
  app.add_flag("--allow-bare", allow_bare,
               "Accept layers of which more than half stays without plastic, because it is too thin.")
      ->group("Job");
  add_value(app, "--threads", threads, "N",
            "Number of planning threads. Default: one for each core. The result does not depend on it.")
      .check(integer_between(1, most_threads))
      ->group("Planning");
}

void JobOptions::declare_full_quality(CLI::App& app) {
  app.add_flag("--full-quality", full_quality,
               "Plan each layer with full effort, even if the nozzle has to wait. Without this option the "
               "effort is reduced before the nozzle would have to wait.")
      ->group("Planning");
}

void JobOptions::declare_sliced(CLI::App& app) {
  app.get_option("JOB")->description(
      "The job, a TOML file (see unicursal-job(5)), a model: .svg, .stl, .3mf, .obj or .amf, or a slicer's "
      ".gcode.");
  app.add_flag("--no-tower", no_tower, "Leave out the wipe tower of a slicer's G-code.")->group("Job");
  app.add_flag("--allow-stops", allow_stops,
               "Allow a slicer's G-code to wait for a person, who answers at the printer (M0, M600).")
      ->group("Job");
}

void SimulatedPrinter::declare(CLI::App& app) {
  constexpr auto group = "Simulated printer";
  add_value(app, "--personality", personality, "FIRMWARE",
            "Firmware to simulate: marlin, marlin-8bit, marlin-advanced-ok, marlin-host, marlin-few-tools, "
            "marlin-plain, repetier, repetier-0.92 or reprapfirmware. Default: the firmware of the profile.")
      .group(group);
  add_value(app, "--usb", options.usb, "none|cdc|ftdi",
            "USB chip of the cable: cdc delays by 1 ms, ftdi by 16 ms. Default: cdc.")
      .group(group);
  declare_tanks(app, options.tanks);
  add_values(app, "--fault", options.faults, "FAULT",
             "Inject this fault (see --help-faults). May be repeated.")
      .group(group);
  add_value(app, "--faults", options.fault_file, "FILE",
            "Inject the faults of this file: one on each line, and optionally a line `seed NUMBER`.")
      .group(group);
  add_value(app, "--seed", options.seed, "NUMBER",
            "Seed of random faults. The same seed gives the same faults. Default: 1.")
      .check(integer_between(0, std::numeric_limits<std::uint64_t>::max()))
      ->group(group);
  app.add_flag_callback("--help-faults", show_faults, "List the faults, and do nothing else.")->group(group);
}

void SimulatedPrinter::check() const {
  try {
    sim::check(options);
  } catch (const std::invalid_argument& error) {
    throw core::DataError("", "", error.what(), "");  // it names what is possible
  } catch (const std::system_error& error) {
    throw core::DataError("", "", error.what(), "check the file's name and permissions");
  }
}

void declare_layers(CLI::App& app, std::optional<LayerRange>& layers, const std::string& help) {
  const auto parse = [&layers](const std::string& text) { layers = parse_layers(text); };
  app.add_option_function<std::string>("--layers", parse, help)->option_text("A:B")->group("Job");
}

CLI::Option& declare_port(CLI::App& app, std::optional<std::string>& port, const std::string& otherwise) {
  return add_value(app, "--port", port, "PORT",
                   "Serial port of the printer, or auto to search for it. Default: " + otherwise + ".");
}

void declare_log(CLI::App& app, std::optional<std::filesystem::path>& log) {
  add_value(app, "--log", log, "FILE",
            "Write every byte of the serial line to this file. An older file is renamed to FILE.1 and so on.")
      .group("Output");
}

void declare_spool(CLI::App& app, std::optional<std::filesystem::path>& spool) {
  add_value(app, "--spool", spool, "DIR",
            "Folder in which prints are kept so that they can be resumed. Default: unicursal/prints in "
            "$XDG_STATE_HOME or ~/.local/state.");
}

void declare_state(CLI::App& app, std::optional<std::filesystem::path>& state) {
  add_value(app, "--state", state, "DIR",
            "State folder of the daemon. Default: unicursal/daemon in $XDG_STATE_HOME or ~/.local/state.");
}

void declare_events(CLI::App& app, DisplayOptions& display) {
  app.add_flag("--json", display.json, "Write events to standard output, one JSON object on each line.")
      ->group("Output");
}

void declare_quiet(CLI::App& app, bool& quiet) {
  app.add_flag("-q,--quiet", quiet, "Show only warnings, errors and the end.")->group("Output");
}

void declare_pause_heat(CLI::App& app, PauseHeat& heat) {
  const auto choose = [&heat](const std::string& word) {
    heat = word == "lower" ? PauseHeat::lower : PauseHeat::keep;
  };
  app.add_option_function<std::string>(
         "--pause-heat", choose,
         "What to do with the nozzle's heat during a pause: lower it by 60 °C at once, or keep it and lower "
         "it after 15 minutes. Default: keep.")
      ->option_text("keep|lower")
      ->check(one_of({"keep", "lower"}));
}

void declare_tanks(CLI::App& app, std::optional<std::size_t>& tanks) {
  add_value(app, "--tanks", tanks, "N",
            "Number of stirred tanks in series that model the nozzle's mixing chamber, 1 to 8. Default: the "
            "profile's number, or 2.")
      .check(integer_between(1, 8))
      ->group("Simulated printer");
}

void add_steering_note(CLI::App& app) {
  add_note(
      app,
      "While it prints in a terminal, type a word and Enter to steer it: pause, resume, cancel (park and "
      "cool), stop (stop at once), speed 80 or flow 95 (per cent), nozzle 205 or bed 55 (°C). Ctrl-C "
      "cancels; Ctrl-C again stops at once.");
}

}  // namespace unicursal::host
