#include <fmt/format.h>

#include <future>
#include <iostream>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "host/cli/commands.hpp"
#include "host/cli/common.hpp"
#include "host/cli/show.hpp"
#include "host/dry_run/lockstep_clock.hpp"
#include "host/dry_run/simulator_process.hpp"
#include "host/files/whole_file.hpp"
#include "host/job/profile_edit.hpp"
#include "host/report/summary.hpp"
#include "host/tune/raster_reader.hpp"
#include "host/tune/terminal_reader.hpp"

namespace unicursal::host {
namespace {

constexpr const char* usual_pictures = "transition-strip";

/// What the command line says.
class GivenReader final : public StripReader {
 public:
  explicit GivenReader(const TuneCommand& command) : command_(command) {}

  StripReading read(const Strip& strip) override {
    StripReading reading{*command_.began * strip.tick, *command_.stopped * strip.tick, {}};
    if (command_.half) reading.half = *command_.half * strip.tick;
    return reading;
  }

 private:
  const TuneCommand& command_;
};

void check_feeders(const TuneCommand& command, const Profile& profile) {
  const auto feeders = static_cast<std::size_t>(profile.printer.feeders);
  for (const auto& [option, feeder] :
       {std::pair{"--from", command.feeders.from}, std::pair{"--to", command.feeders.to}}) {
    if (feeder < feeders) continue;
    throw core::DataError("", option, fmt::format("this printer has no feeder {}", feeder + 1),
                          fmt::format("choose one of 1 to {}", feeders));
  }
  if (command.feeders.from != command.feeders.to) return;
  throw core::DataError("", "--to", "is the same feeder as --from", "choose two of different colours");
}

void check_output(const TuneCommand& command) {
  if (!command.output) return;
  for (const auto& input : {std::optional(command.profile), command.machine}) {
    std::error_code none;
    if (!input || !std::filesystem::equivalent(*command.output, *input, none)) continue;
    throw core::DataError(command.output->string(), "", "is a profile, which would be lost",
                          "choose another name for the G-code");
  }
}

void write_gcode(const FinishedPrint& print, const std::filesystem::path& file) {
  WholeFile whole(file);
  const auto write = [&](const gcode::Chunk& chunk) {
    for (const std::string& line : chunk.lines) whole.stream() << line << '\n';
  };
  write(print.start);
  for (const gcode::Chunk& chunk : print.body) write(chunk);
  write(print.finish);
  whole.publish();
  show(stdout, "written:   {}\n", file.string());
}

/// Throws PrintError when the print failed, TuningCancelled when it was stopped.
void expect_whole(const StreamResult& result) {
  if (result.unfit) throw PrinterUnfit(result.reason);
  if (result.ending == Ending::failed) throw PrintError(result.reason);
  if (result.ending == Ending::stopped) throw TuningCancelled("the strip was not printed to its end");
}

void print_on(const std::string& port, const Profile& profile, const FinishedPrint& print) {
  FinishedSource source(print, profile.printer);
  StreamSettings settings;
  settings.profile = profile.file;
  settings.link = link_options(profile, {});
  const int open = open_port(port, profile.baud, settings.link);
  expect_whole(stream_with_progress(open, source, {}, settings));
}

std::vector<std::string> simulator_arguments(const TuneCommand& command, const Profile& profile,
                                             const std::optional<std::filesystem::path>& pictures) {
  std::vector<std::string> arguments = {"--profile", command.machine.value_or(command.profile).string(),
                                        "--baud",    fmt::format("{}", profile.baud),
                                        "--tanks",   fmt::format("{}", command.tanks)};
  if (pictures) arguments.insert(arguments.end(), {"--picture", pictures->string()});
  return arguments;
}

/// Pictures are for who reads them.
std::optional<std::filesystem::path> pictures_of(const TuneCommand& command) {
  if (command.pictures || command.read_simulated || command.began) return command.pictures;
  return usual_pictures;
}

/// The simulator ends only when nothing holds its clock any more.
StreamSettings in_lockstep(const SimulatorProcess& simulator, const Profile& profile) {
  StreamSettings settings;
  settings.profile = profile.file;
  settings.clock = std::make_shared<LockstepClock>(simulator.control());
  return settings;
}

std::unique_ptr<StripOnRaster> print_simulated(const TuneCommand& command, const Profile& profile,
                                               const Strip& strip, const FinishedPrint& print) {
  if (command.machine) load_profile(*command.machine);
  auto seen = std::make_unique<StripOnRaster>(strip, strip_mixtures(profile.printer, command.feeders));
  const auto pictures = pictures_of(command);
  std::future<void> watching;  // outlives the simulator, whose end is that of the stream it waits for
  SimulatorProcess simulator(simulator_arguments(command, profile, pictures),
                             SimulatorProcess::Time::lockstep);
  watching = std::async(std::launch::async, [&seen, rasters = simulator.take_rasters()] {
    sim::RasterReader reader(rasters);
    while (const auto frame = reader.next()) seen->take(*frame, reader);
  });
  FinishedSource source(print, profile.printer);
  expect_whole(stream_with_progress(open_port(simulator.port(), profile.baud), source, {},
                                    in_lockstep(simulator, profile)));
  simulator.finish();
  watching.get();
  if (pictures) show(stdout, "picture:   {}\n", (*pictures / "deposit-0000.png").string());
  return seen;
}

std::unique_ptr<StripReader> reader_for(const TuneCommand& command, std::unique_ptr<StripReader> simulated) {
  if (command.began) return std::make_unique<GivenReader>(command);
  if (command.read_simulated) return simulated;
  return std::make_unique<TerminalReader>(std::cin, std::cout);
}

void tell(const Strip& strip, const FinishedPrint& print) {
  double seconds = 0, volume = 0;
  for (const gcode::Chunk& chunk : print.body) seconds += chunk.seconds, volume += chunk.volume;
  show(stdout,
       "strip:     {} ticks of {:g} mm in {} lane{}, shows a transition of up to {:.0f} mm³; {:.0f} mm³ and "
       "about {} in all\n",
       strip.points.size() - 1, strip.tick, strip.lanes, strip.lanes == 1 ? "" : "s", strip.volume(), volume,
       duration_words(seconds));
}

void tell(const Strip& strip, const StripReading& reading) {
  const auto tick = [&](double along) { return along / strip.tick; };
  show(stdout, "read:      began at tick {:g},{} stopped at tick {:g}\n", tick(reading.began),
       reading.half ? fmt::format(" half changed at {:g},", tick(*reading.half)) : "", tick(reading.stopped));
}

void tell(const Transition& found, const gcode::Printer& printer) {
  const auto line = [](const char* name, const Estimate& estimate, double before) {
    show(stdout, "{}{:.2f} mm³, give or take {:.2f} (the profile says {:g})\n", name, estimate.value,
         estimate.uncertainty, before);
  };
  line("dead:      ", found.dead, printer.dead_volume);
  line("mixing:    ", found.mixing, printer.mixing_volume);
  if (found.widened > 1) {
    show(stdout, "The readings fit no nozzle to the tick; looking once more may give better numbers.\n");
  }
}

void settle(const TuneCommand& command, const ProfileText& text, const Profile& profile, const Strip& strip,
            StripReader& reader) {
  const StripReading reading = reader.read(strip);
  tell(strip, reading);
  const Transition found = fit_transition(volumes_of(strip, reading));
  tell(found, profile.printer);
  const std::string question = fmt::format("Write both into {}?", command.profile.string());
  if (!command.yes && !confirmed(std::cin, std::cout, question)) throw TuningCancelled("as you wished");
  text.set_transition(found.dead.value, found.mixing.value);
  show(stdout, "written:   {}\n", command.profile.string());
}

}  // namespace

Exit tune(const TuneCommand& command) {
  const Profile profile = load_profile(command.profile);
  const ProfileText text(command.profile);
  check_feeders(command, profile);
  check_output(command);
  const Strip strip = make_strip(profile.printer, command.range);
  const FinishedPrint print = strip_print(strip, profile.printer, command.feeders);
  tell(strip, print);
  try {
    if (command.output) write_gcode(print, *command.output);
    std::unique_ptr<StripReader> simulated;
    if (command.simulate) simulated = print_simulated(command, profile, strip, print);
    if (command.port) print_on(*command.port, profile, print);
    const bool printed = command.simulate || command.port;
    if (command.output && !printed && !command.began) {
      show(stdout, "Print it, then call this again without -o to be asked what it shows.\n");
      return Exit::success;
    }
    settle(command, text, profile, strip, *reader_for(command, std::move(simulated)));
    return Exit::success;
  } catch (const TuningCancelled& cancelled) {
    show(stdout, "{}; the profile is as it was\n", cancelled.what());
    return Exit::failed;
  }
}

}  // namespace unicursal::host
