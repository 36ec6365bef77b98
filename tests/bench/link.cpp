// Measures the link against simulated printers in processes of their own:
//
//   bench_link soak [LINES]
//     Every personality, with faults on one line in a thousand each, in virtual time. Prints whether every
//     line was executed once and in order.
//   bench_link wire
//     Share of a 250 000 baud line that is used by lines of 40 bytes, in virtual time.
//   bench_link race [LINES]
//     Lines per second over a pseudo-terminal of unlimited speed with one line in flight, beside those of
//     Debian's printcore; processor time of the link for each line.
//
// Without an argument it runs all three.
#include <fcntl.h>
#include <fmt/format.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <asio/co_spawn.hpp>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "host/cli/cli.hpp"
#include "host/dry_run/lockstep_clock.hpp"
#include "host/dry_run/simulator_process.hpp"
#include "host/link/link.hpp"

using namespace unicursal::host;

namespace {

using Time = std::chrono::steady_clock;

constexpr const char* printcore = "/usr/bin/printcore";
constexpr double baud = 250000;
constexpr std::size_t wire_lines = 20000, wire_line = 40;  // bytes, with number and checksum

double seconds_since(Time::time_point begun) {
  return std::chrono::duration<double>(Time::now() - begun).count();
}

double processor_seconds(int who) {
  rusage usage{};
  getrusage(who, &usage);
  const auto seconds = [](const timeval& part) {
    return static_cast<double>(part.tv_sec) + 1e-6 * static_cast<double>(part.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

void swallow(int descriptor) {
  std::array<char, 65536> bytes;
  while (::read(descriptor, bytes.data(), bytes.size()) > 0) {
  }
  ::close(descriptor);
}

struct Result {
  LinkStatistics statistics;
  double seconds = 0;    ///< s of the link's clock that the lines took
  double processor = 0;  ///< processor time of this process meanwhile, s
};

Result stream(const std::string& port, const std::vector<std::string>& lines, const LinkOptions& options) {
  asio::io_context loop{1};
  Link link(loop.get_executor(), open_port(port, static_cast<unsigned>(baud)), options);
  std::exception_ptr failure;
  Result result;
  asio::co_spawn(
      loop,
      [&]() -> asio::awaitable<void> {
        co_await link.connect();
        const TimePoint begun = options.clock->now();
        const double spent = processor_seconds(RUSAGE_SELF);
        co_await link.send(lines);
        co_await link.drain();
        result.seconds = std::chrono::duration<double>(options.clock->now() - begun).count();
        result.processor = processor_seconds(RUSAGE_SELF) - spent;
      },
      [&](std::exception_ptr thrown) {
        failure = thrown;
        loop.stop();
      });
  options.clock->run(loop);
  result.statistics = link.statistics();
  if (failure) std::rethrow_exception(failure);
  return result;
}

/// A folder that is removed with this object.
class Folder {
 public:
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "unicursal-bench-XXXXXX").string();
    if (!mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
    path_ = name;
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  std::filesystem::path operator/(const char* name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

// ---- soak

std::vector<std::string> moves(std::size_t count) {
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < count; ++i) {
    lines.push_back(fmt::format("G1 X{:.3f} Y{:.3f} E{:.5f}", 10 + 0.001 * static_cast<double>(i % 150000),
                                10 + 0.5 * static_cast<double>(i % 2), 1e-5 * static_cast<double>(i % 997)));
  }
  return lines;
}

struct Order {
  std::uint64_t once = 0;    ///< lines that were executed in their turn
  std::uint64_t wrong = 0;   ///< lines that were executed in their turn, but not as they were sent
  std::uint64_t others = 0;  ///< other lines that were executed: damaged ones, and the link's own
};

/// Compares both lists in order. A line that was changed on its way counts as another one until the next line
/// fits.
Order compare(const std::vector<std::string>& lines, const std::filesystem::path& transcript) {
  Order order;
  std::ifstream stream(transcript);
  std::size_t next = 0;
  for (std::string executed; std::getline(stream, executed);) {
    if (next < lines.size() && executed == lines[next]) {
      ++next, ++order.once;
    } else if (next + 1 < lines.size() && executed == lines[next + 1] && order.others > 0) {
      next += 2;
      ++order.once, ++order.wrong, --order.others;
    } else {
      ++order.others;
    }
  }
  return order;
}

void soak(const std::string& personality, std::size_t count) {
  const Folder folder;
  const auto transcript = folder / "transcript";
  const auto lines = moves(count);
  // A chance applies to each byte (about 40 in a line, half as many in a reply), or to each line or reply.
  const std::vector<std::string> faults = {"bitflip:2.5e-5", "lostbyte:2.5e-5", "lostok:1e-3",
                                           "noise:1e-3",     "falsealarm:1e-3", "doubleresend:0.5"};
  std::vector<std::string> arguments = {"--personality", personality, "--transcript", transcript.string()};
  for (const std::string& fault : faults) arguments.insert(arguments.end(), {"--fault", fault});
  const auto begun = Time::now();
  SimulatorProcess simulator(arguments, SimulatorProcess::Time::lockstep);
  std::jthread reader([descriptor = simulator.take_rasters()] { swallow(descriptor); });
  LinkOptions options;
  options.clock = std::make_shared<LockstepClock>(simulator.control());
  const Result result = stream(simulator.port(), lines, options);
  options.clock.reset();
  const nlohmann::json seen = simulator.finish();
  const Order order = compare(lines, transcript);
  const nlohmann::json& counts = seen.at("lines");
  std::string struck;
  for (const auto& [name, times] : seen.at("faults").items())
    struck += fmt::format(" {} {}", name, times.get<int>());
  fmt::print(
      "{:<20} {:>8} lines: {} once and in order, {} changed by damage that the checksum does not see ({} "
      "such, "
      "as the simulator counts), numbers in order: {}\n"
      "{:<20} faults:{}; {} resends, {} probes; {:.0f} lines/s of printer time; {:.0f} s here\n",
      personality, lines.size(), order.once, order.wrong, counts.at("unseen_damage").get<int>(),
      seen.at("executed_lines_in_order").get<bool>() ? "yes" : "NO", "", struck, result.statistics.resends,
      result.statistics.probes, static_cast<double>(lines.size()) / result.seconds, seconds_since(begun));
}

// ---- wire

/// Lines that have 40 bytes with their number and checksum, from number 1 on.
std::vector<std::string> full_lines(std::size_t count) {
  std::vector<std::string> lines;
  for (std::size_t i = 1; i <= count; ++i) {
    std::string command = "M117 ";
    const auto framed_size = [&] {
      const std::string head = fmt::format("N{} {}", i, command);
      unsigned char checksum = 0;
      for (const char c : head)
        checksum = static_cast<unsigned char>(checksum ^ static_cast<unsigned char>(c));
      return fmt::format("{}*{}\n", head, checksum).size();
    };
    while (framed_size() < wire_line) command += static_cast<char>('a' + i % 26);
    lines.push_back(command);
  }
  return lines;
}

void wire() {
  const auto lines = full_lines(wire_lines);
  for (const char* personality : {"marlin", "marlin-advanced-ok", "repetier"}) {
    for (const char* usb : {"cdc", "ftdi"}) {
      SimulatorProcess simulator({"--personality", personality, "--usb", usb},
                                 SimulatorProcess::Time::lockstep);
      std::jthread reader([descriptor = simulator.take_rasters()] { swallow(descriptor); });
      LinkOptions options;
      options.clock = std::make_shared<LockstepClock>(simulator.control());
      const Result result = stream(simulator.port(), lines, options);
      options.clock.reset();
      simulator.finish();
      const double used = static_cast<double>(result.statistics.bytes) * 10 / baud / result.seconds;
      fmt::print("{:<20} {:<5} {:>6.1f} lines/s, {:.1f} % of the line\n", personality, usb,
                 static_cast<double>(lines.size()) / result.seconds, 100 * used);
    }
  }
}

// ---- race

/// A simulator of unlimited speed whose port is ready.
class Printer {
 public:
  Printer() {
    std::array<int, 2> words{};
    if (pipe2(words.data(), O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
    child_ = fork();
    if (child_ == 0) {
      dup2(words[1], STDOUT_FILENO);
      execl("/proc/self/exe", "unicursal", "simulate", "--once", nullptr);
      _exit(127);
    }
    close(words[1]);
    for (char c = 0; ::read(words[0], &c, 1) == 1 && c != '\n';) port_ += c;
    close(words[0]);
  }
  ~Printer() {
    int status = 0;
    waitpid(child_, &status, 0);  // it ends when its host does
  }
  Printer(const Printer&) = delete;
  Printer& operator=(const Printer&) = delete;

  const std::string& port() const { return port_; }

 private:
  pid_t child_ = -1;
  std::string port_;
};

/// Wall time of a whole run of printcore, s; absent if it is not installed or fails.
std::optional<double> printcore_seconds(const std::vector<std::string>& lines) {
  if (!std::filesystem::exists(printcore)) return std::nullopt;
  const Folder folder;
  const std::string file = (folder / "lines.gcode").string();
  {
    std::ofstream stream(file);
    for (const std::string& line : lines) stream << line << '\n';
  }
  const Printer printer;
  const auto begun = Time::now();
  const pid_t child = fork();
  if (child == 0) {
    const int nowhere = open("/dev/null", O_RDWR);
    dup2(nowhere, STDOUT_FILENO);
    dup2(nowhere, STDERR_FILENO);
    execl(printcore, printcore, "-b", "250000", printer.port().c_str(), file.c_str(), nullptr);
    _exit(127);
  }
  int status = 0;
  waitpid(child, &status, 0);
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) return std::nullopt;
  return seconds_since(begun);
}

void race(std::size_t count) {
  LinkOptions options;
  options.receive_buffer = 1;  // one line always fits
  options.boot = std::chrono::milliseconds(500);
  const auto lines = moves(count);
  // printcore also starts, connects and ends, so the difference of two runs is the time of the lines.
  const auto few = std::vector<std::string>(lines.begin(), lines.begin() + 1000);
  const auto more = std::vector<std::string>(lines.begin(), lines.begin() + 4000);
  double ours = 0, theirs = 0, processor = 0;
  for (int round = 0; round < 3; ++round) {
    const Printer printer;
    const Result result = stream(printer.port(), lines, options);
    ours = std::max(ours, static_cast<double>(lines.size()) / result.seconds);
    processor = result.processor / static_cast<double>(lines.size());
    const auto short_run = printcore_seconds(few), long_run = printcore_seconds(more);
    if (short_run && long_run && *long_run > *short_run)
      theirs = std::max(theirs, static_cast<double>(more.size() - few.size()) / (*long_run - *short_run));
  }
  fmt::print(
      "one line in flight: {:.0f} lines/s, {:.1f} µs of processor time each ({:.2f} % of one core at "
      "625 lines/s)\n",
      ours, 1e6 * processor, 100 * processor * 625);
  if (theirs > 0)
    fmt::print("printcore: {:.0f} lines/s; {:.1f} ×\n", theirs, ours / theirs);
  else
    fmt::print("printcore: not installed, or it failed\n");
}

}  // namespace

int main(int argc, char** argv) {
  const std::string_view what = argc > 1 ? argv[1] : "";
  if (what == "simulate") return run_command_line(argc, argv);
  const std::size_t count = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 0;
  try {
    if (what.empty() || what == "race") race(std::max<std::size_t>(count > 0 ? count : 100000, 4000));
    if (what.empty() || what == "wire") wire();
    if (what.empty() || what == "soak") {
      for (const char* personality : {"marlin", "marlin-8bit", "marlin-advanced-ok", "repetier"})
        soak(personality, count > 0 ? count : 1000000);
    }
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}
