// Measures the speed of virtual time. The host's own link streams G-code files of `unicursal plan` in
// lockstep with a simulated printer. No layer is planned and no picture is drawn meanwhile; the deposit is
// laid and handed over as in any dry run. Prints printer seconds per real second, and per second of processor
// time of both processes.
#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <asio/co_spawn.hpp>
#include <chrono>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "firmware_gcode/print/chunk.hpp"
#include "host/cli/cli.hpp"
#include "host/dry_run/lockstep_clock.hpp"
#include "host/dry_run/simulator_process.hpp"
#include "host/link/link.hpp"

using namespace unicursal::host;

namespace {

std::vector<std::string> read_commands(const char* file) {
  std::ifstream stream(file);
  if (!stream) throw std::runtime_error(fmt::format("{} cannot be read", file));
  std::vector<std::string> commands;
  for (std::string line; std::getline(stream, line);) {
    line = line.substr(0, line.find(';'));
    while (line.ends_with(' ')) line.pop_back();
    if (unicursal::gcode::is_command(line)) commands.push_back(line);
  }
  return commands;
}

double processor_seconds() {
  double sum = 0;
  for (const auto who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
    rusage usage{};
    getrusage(who, &usage);
    for (const timeval& part : {usage.ru_utime, usage.ru_stime}) {
      sum += static_cast<double>(part.tv_sec) + 1e-6 * static_cast<double>(part.tv_usec);
    }
  }
  return sum;
}

void stream(SimulatorProcess& simulator, const std::vector<std::string>& commands) {
  asio::io_context loop{1};
  LinkOptions options;
  options.clock = std::make_shared<LockstepClock>(simulator.control());
  Link link(loop.get_executor(), open_port(simulator.port(), 250000), options);
  std::exception_ptr failure;
  asio::co_spawn(
      loop,
      [&]() -> asio::awaitable<void> {
        co_await link.connect();
        co_await link.send(commands);
        co_await link.drain();
      },
      [&](std::exception_ptr thrown) {
        failure = thrown;
        loop.stop();
      });
  options.clock->run(loop);
  if (failure) std::rethrow_exception(failure);
}

void swallow(int descriptor) {
  std::array<char, 65536> bytes;
  while (::read(descriptor, bytes.data(), bytes.size()) > 0) {
  }
  ::close(descriptor);
}

void measure(const char* file, const std::string& usb) {
  const std::vector<std::string> commands = read_commands(file);
  const auto begun = std::chrono::steady_clock::now();
  const double spent = processor_seconds();
  SimulatorProcess simulator({"--usb", usb}, SimulatorProcess::Time::lockstep);
  std::jthread reader([descriptor = simulator.take_rasters()] { swallow(descriptor); });
  stream(simulator, commands);
  const nlohmann::json report = simulator.finish();
  const double seconds = report.at("printer_seconds");
  const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
  const double processor = processor_seconds() - spent;
  fmt::print(
      "{:<40} {:<5} {:>8} lines {:>9.0f} printer s {:>7.2f} s {:>7.0f} × real time {:>7.2f} s CPU {:>7.0f} "
      "×\n",
      file, usb, commands.size(), seconds, wall, seconds / wall, processor, seconds / processor);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc > 1 && std::string_view(argv[1]) == "simulate") return run_command_line(argc, argv);
  try {
    for (int i = 1; i < argc; ++i) {
      for (const char* usb : {"cdc", "ftdi"}) measure(argv[i], usb);
    }
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}
