#include "host/cli/test_printing.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <array>
#include <future>
#include <memory>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "host/cli/arguments.hpp"
#include "host/cli/foreground.hpp"
#include "host/cli/terminal_output.hpp"
#include "host/dry_run/lockstep_clock.hpp"
#include "host/dry_run/simulator_process.hpp"
#include "host/files/whole_file.hpp"
#include "host/tune/reading.hpp"

namespace unicursal::host {
namespace {

void expect_whole(bool stopped, const std::string& name) {
  if (stopped) throw TuningCancelled(fmt::format("{} was not printed to its end", name));
}

std::vector<std::string> simulator_arguments(const SimulatedTest& simulated, const Profile& profile) {
  std::vector<std::string> arguments = {"--profile", simulated.machine.string(), "--baud",
                                        fmt::format("{}", profile.baud)};
  if (simulated.tanks) arguments.insert(arguments.end(), {"--tanks", fmt::format("{}", *simulated.tanks)});
  if (simulated.pictures) arguments.insert(arguments.end(), {"--picture", simulated.pictures->string()});
  return arguments;
}

/// Keeps the stream in a file, if there is one. Returns a descriptor to read the stream from. The stream is
/// read to its end whatever happens to the file, since the simulated printer waits for it.
int kept_stream(int stream, std::unique_ptr<WholeFile> file,
                const std::optional<std::filesystem::path>& kept) {
  if (!file) return stream;
  std::array<char, 65536> bytes;
  ssize_t count = 0;
  while ((count = ::read(stream, bytes.data(), bytes.size())) > 0) file->stream().write(bytes.data(), count);
  ::close(stream);
  file->publish();
  const int again = ::open(kept->c_str(), O_RDONLY | O_CLOEXEC);
  if (again < 0) throw core::FileError(kept->string(), "", "cannot be read", "check the permissions");
  return again;
}

/// The simulator ends when the last copy of this clock is gone.
StreamSettings in_lockstep(const SimulatorProcess& simulator, const Profile& profile) {
  StreamSettings settings;
  settings.profile = profile.file;
  settings.clock = std::make_shared<LockstepClock>(simulator.control());
  return settings;
}

}  // namespace

CLI::Option* TestOptions::declare(CLI::App& app, const std::string& what) {
  constexpr auto printing = "Printing", reading = "Reading";
  add_value(app, "PROFILE", profile, " ", "The printer's profile: see unicursal-profile(5).").required();
  CLI::Option& ports =
      add_value(app, "--port", port, "PORT",
                "Print " + what + " on this serial port, or auto to search for the printer.");
  ports.group(printing);
  add_value(app, "-o,--output", output, "FILE", "Write " + what + " to this file, as G-code.")
      .group(printing);
  CLI::Option* simulated =
      app.add_flag("--simulate", simulate, "Print " + what + " on the simulated printer.");
  app.add_flag("--yes", yes, "Write to the profile without asking.")->group(reading);
  return simulated->excludes(&ports)->option_text(" ")->group(printing);
}

void write_gcode(const FinishedPrint& print, const std::filesystem::path& file) {
  WholeFile whole(file);
  const auto lines_of = [&](const gcode::Chunk& chunk) {
    for (const std::string& line : chunk.lines) whole.stream() << line << '\n';
  };
  lines_of(print.start);
  for (const gcode::Chunk& chunk : print.body) lines_of(chunk);
  lines_of(print.finish);
  whole.publish();
  show(stdout, "written:   {}\n", file.string());
}

void expect_other_file(const std::optional<std::filesystem::path>& output,
                       const std::vector<std::optional<std::filesystem::path>>& inputs) {
  if (!output) return;
  for (const auto& input : inputs) {
    std::error_code none;
    if (!input || !std::filesystem::equivalent(*output, *input, none)) continue;
    throw core::DataError(output->string(), "", "is an input, which would be lost", "choose another name");
  }
}

void print_test(const std::string& port, const Profile& profile, const FinishedPrint& print,
                const std::string& name) {
  FinishedSource source(print, profile.printer);
  StreamSettings settings;
  settings.profile = profile.file;
  settings.link = link_options(profile, {});
  expect_whole(stream_or_cool(port, profile, source, std::move(settings)), name);
}

void simulate_test(const SimulatedTest& simulated, const Profile& profile, const FinishedPrint& print,
                   const std::string& name, const LayerTaker& take) {
  load_profile(simulated.machine);
  std::unique_ptr<WholeFile> kept;
  if (simulated.rasters) kept = std::make_unique<WholeFile>(*simulated.rasters);
  std::future<void> watching;  // outlives the simulator, whose end is that of the stream it waits for
  SimulatorProcess simulator(simulator_arguments(simulated, profile), SimulatorProcess::Time::lockstep);
  watching = std::async(std::launch::async, [&, rasters = simulator.take_rasters()] {
    sim::RasterReader reader(kept_stream(rasters, std::move(kept), simulated.rasters));
    while (const auto frame = reader.next()) take(*frame, reader);
  });
  FinishedSource source(print, profile.printer);
  const StreamResult result = stream_with_progress(open_port(simulator.port(), profile.baud), source, {},
                                                   in_lockstep(simulator, profile))
                                  .stream;
  throw_if_failed(result);
  expect_whole(result.ending == Ending::stopped, name);
  simulator.finish();
  watching.get();
  if (simulated.pictures)
    show(stdout, "picture:   {}\n", (*simulated.pictures / "deposit-0000.png").string());
}

void skip_layer(const sim::RasterFrame& frame, sim::RasterReader& rasters) {
  std::vector<sim::RasterPixel> pixels(frame.columns);
  for (std::uint64_t row = 0; row < frame.rows; ++row) rasters.read_row(pixels);
}

TestAmount amount_of(const FinishedPrint& print) {
  TestAmount amount;
  for (const gcode::Chunk& chunk : print.body) amount.seconds += chunk.seconds, amount.volume += chunk.volume;
  return amount;
}

}  // namespace unicursal::host
