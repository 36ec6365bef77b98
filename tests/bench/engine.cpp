// Measures whether the nozzle ever waits for the host, with the real program and its simulated printer as
// processes.
//
//   bench_engine starve JOB…
//     Whole jobs in virtual time, with planning charged at ×1 and ×8 of what it takes here. Prints how often
//     the printer's queue ran dry in a curve; how long the print waited for layers, including those that a
//     hot printer needs before its first bead; how far the quality was lowered; and the memory of the host.
//   bench_engine start JOB…
//     `print` on a printer that is hot and homed. Prints the time to the first extruding move, less what the
//     printer takes for the lines before it (homing, last degrees of heat).
//   bench_engine live MINUTES JOB…
//     In real time. Prints starvations, and the share of a core of each kind of thread.
//
// The figures depend on the computer and its load. s, MiB.
#include <dirent.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/stat.h>

#include <algorithm>
#include <asio/co_spawn.hpp>
#include <asio/io_context.hpp>
#include <charconv>
#include <chrono>
#include <cstdlib>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "host/job/job.hpp"
#include "host/job/load_job.hpp"
#include "host/link/link.hpp"
#include "tests/host/support/child_process.hpp"

namespace {

using namespace unicursal;
using nlohmann::json;
using test::Child;
using Clock = std::chrono::steady_clock;

constexpr int look_again = 2;      ///< ms
constexpr std::size_t early = 10;  ///< the layer at which memory is measured first
constexpr double longest = 3600;   ///< s; the longest that a process may take to start

double since(Clock::time_point then) {
  return std::chrono::duration<double>(Clock::now() - then).count();
}

void nap(int milliseconds) {
  poll(nullptr, 0, milliseconds);
}

std::string name_of(const std::string& job) {
  return std::filesystem::path(job).stem().string();
}

// ---- in virtual time

/// A figure of a process by its name in /proc, KiB; 0 if the process has ended.
double memory(pid_t process, const std::string& what) {
  std::istringstream status(test::read_text(fmt::format("/proc/{}/status", process)));
  for (std::string line; std::getline(status, line);) {
    if (line.rfind(what, 0) == 0) return std::strtod(line.c_str() + what.size(), nullptr);
  }
  return 0;
}

/// The layer in the last event of a print.
std::size_t layer_in(const std::string& events) {
  const auto at = events.rfind("\"layer\":");
  return at == std::string::npos ? 0 : std::strtoul(events.c_str() + at + 8, nullptr, 10);
}

struct Memory {
  double at_ten = 0, most = 0;  ///< MiB, peak so far
};

Memory watch(const Child& child) {
  constexpr double mib = 1024;
  Memory seen;
  while (child.running()) {
    const double peak = memory(child.id(), "VmHWM:") / mib;
    seen.most = std::max(seen.most, peak);
    if (seen.at_ten == 0 && layer_in(child.out()) >= early) seen.at_ten = peak;
    nap(100);
  }
  return seen;
}

/// The layers that were planned in less time than they needed, with their effort: "3 7 8 …".
std::string hurried_layers(const json& report) {
  std::string text;
  int more = 0;
  for (const json& layer : report["layers"]) {
    if (!layer.contains("effort")) continue;
    if (text.size() < 60)
      text += fmt::format(" {}:{:.2f}", layer["layer"].get<int>(), layer["effort"].get<double>());
    else
      ++more;
  }
  return more > 0 ? text + fmt::format(" and {} more", more) : text;
}

void starve(const std::string& job) {
  for (const char* charge : {"1", "8"}) {
    const test::TempFolder folder;
    const std::string file = folder / "report.json";
    const auto begun = Clock::now();
    Child child({"dry-run", job, "--charge-planning", charge, "--json", "--report", file});
    const Memory seen = watch(child);
    const test::Outcome outcome = child.wait();
    if (outcome.code != 0) throw std::runtime_error(job + ": " + outcome.err);
    const json report = json::parse(test::read_text(file));
    const json &motion = report["motion"], &effort = report["effort"];
    fmt::print(
        "{:<16} ×{:<3} {:>6} layers {:>8.0f} s printed  starvations {:>3}, {:>6.2f} s stopped  waited "
        "{:>6.2f} s"
        "  hurried {:>4}, least effort {:.2f}  peak {:>5.0f} MiB{}  ({:.0f} s)\n",
        name_of(job), charge, report["layer_count"].get<int>(),
        report["simulator"]["printing_seconds"].get<double>(), motion["starvations"].get<int>(),
        motion["stopped_seconds"].get<double>(), report["planning"]["waited_seconds"].get<double>(),
        effort["hurried_layers"].get<int>(), effort["least"].get<double>(), seen.most,
        seen.at_ten > 0 ? fmt::format(", {:.0f} at layer {}", seen.at_ten, early) : "", since(begun));
    if (const std::string hurried = hurried_layers(report); !hurried.empty())
      fmt::print("{:<21} layers with less than their effort:{}\n", "", hurried);
    std::fflush(stdout);
  }
}

// ---- in real time

bool extrudes(const std::string& line) {
  const bool moves = line.find(" X") != std::string::npos || line.find(" Y") != std::string::npos;
  return line.rfind("G1 ", 0) == 0 && moves && line.find(" E") != std::string::npos;
}

/// The lines that a print sends up to its first extruding move.
std::vector<std::string> beginning(const std::string& job) {
  const test::TempFolder folder;
  const std::string file = folder / "layer.gcode";
  const test::Outcome outcome = test::run({"plan", job, "--layers", "0:0", "-o", file});
  if (outcome.code != 0) throw std::runtime_error(job + ": " + outcome.err);
  std::istringstream stream(test::read_text(file));
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) {
    line = line.substr(0, line.find(';'));
    while (line.ends_with(' ')) line.pop_back();
    if (!line.empty()) lines.push_back(line);
    if (extrudes(line)) break;
  }
  return lines;
}

/// Follows the commands that the simulated printer executes.
class Transcript {
 public:
  explicit Transcript(const std::string& file) : file_(file) {}

  /// Returns how many extruding moves were executed.
  std::size_t extruding() {
    if (!stream_.is_open()) stream_.open(file_);
    stream_.clear();
    for (std::string line; std::getline(stream_, line);) {
      if (stream_.eof()) {  // not yet whole
        half_ += line;
        return count_;
      }
      if (extrudes(std::exchange(half_, std::string()) + line)) ++count_;
    }
    return count_;
  }
  void await_next(const Child& process) {
    const auto begun = Clock::now();
    const std::size_t before = count_;
    while (extruding() == before) {
      if (!process.running() || since(begun) > longest)
        throw std::runtime_error("it prints nothing: " + process.err());
      nap(look_again);
    }
  }

 private:
  std::string file_, half_;
  std::ifstream stream_;
  std::size_t count_ = 0;
};

class HotPrinter {
 public:
  explicit HotPrinter(const std::string& job)
      : profile_(host::load_job(job).profile),
        lines_(beginning(job)),
        printer_({"simulate", "--speed", "1", "--profile", profile_.file.string(), "--link", port(),
                  "--transcript", folder_ / "lines", "--report", folder_ / "seen.json"}),
        transcript_(folder_ / "lines") {
    while (!std::filesystem::exists(port())) {
      if (!printer_.running()) throw std::runtime_error("no simulator: " + printer_.err());
      nap(look_again);
    }
    send();  // heats, homes and primes
  }

  std::string port() const { return folder_ / "port"; }
  std::string path(const std::string& name) const { return folder_ / name; }
  Transcript& transcript() { return transcript_; }
  /// Ends the process.
  json seen() {
    kill(printer_.id(), SIGTERM);
    printer_.wait();
    return json::parse(test::read_text(folder_ / "seen.json"));
  }

 private:
  void send() {
    asio::io_context loop{1};
    host::Link link(loop.get_executor(), host::open_port(port(), profile_.baud), {});
    std::exception_ptr failure;
    asio::co_spawn(
        loop,
        [&]() -> asio::awaitable<void> {
          co_await link.connect();
          co_await link.send(lines_);
          co_await link.drain();
        },
        [&](std::exception_ptr thrown) {
          failure = thrown;
          loop.stop();
        });
    loop.run();
    if (failure) std::rethrow_exception(failure);
    transcript_.extruding();
  }

  test::TempFolder folder_;
  const host::Profile profile_;
  const std::vector<std::string> lines_;
  Child printer_;
  Transcript transcript_;
};

/// Processor seconds of a process by the name of its threads; the first thread runs the link, "link".
std::map<std::string, double> thread_seconds(pid_t process) {
  std::map<std::string, double> seconds;
  const double tick = 1.0 / static_cast<double>(sysconf(_SC_CLK_TCK));
  std::error_code gone;
  for (const auto& thread :
       std::filesystem::directory_iterator(fmt::format("/proc/{}/task", process), gone)) {
    const std::string stat = test::read_text(thread.path() / "stat");
    const auto open = stat.find('('), close = stat.rfind(')');
    if (close == std::string::npos) continue;
    std::istringstream rest(stat.substr(close + 2));
    std::vector<std::string> fields;
    for (std::string field; rest >> field;) fields.push_back(field);
    const bool first = thread.path().filename() == std::to_string(process);
    const std::string name = first ? "link" : stat.substr(open + 1, close - open - 1);
    // utime and stime are fields 14 and 15; see proc(5).
    seconds[name == "unicursal" ? "disk" : name] +=
        tick * (std::stod(fields.at(11)) + std::stod(fields.at(12)));
  }
  return seconds;
}

/// Time that the printer took for the lines before the first extruding move, from its serial log, s.
double printers_own(const std::string& log) {
  std::istringstream stream(test::read_text(log));
  std::optional<double> begun;
  double last_ok = 0, time = 0;
  char way = 0;
  for (std::string line; stream >> time >> way && std::getline(stream, line);) {
    if (way == '<') {
      if (line.starts_with(" ok")) last_ok = time;
      continue;
    }
    if (line.starts_with(" N") && !begun) begun = time;
    if (line.find(" G1 ") != std::string::npos && line.find(" X") != std::string::npos &&
        line.find(" E") != std::string::npos)
      return last_ok - begun.value_or(time);
  }
  throw std::runtime_error("the serial log has no extruding move");
}

/// `minutes` of printing follow the first extruding move; may be 0.
void print(const std::string& job, double minutes) {
  HotPrinter printer(job);
  const auto begun = Clock::now();
  const std::string log = printer.path("line.log");
  Child host({"print", job, "--port", printer.port(), "--log", log, "--spool", printer.path("spool"),
              "--report", printer.path("report.json")});
  printer.transcript().await_next(host);
  const double first = since(begun), own = printers_own(log);
  fmt::print(
      "{:<16} first extruding move {:.2f} s after `print`; the printer's own part {:.2f} s; added by the "
      "host {:.2f} s\n",
      name_of(job), first, own, first - own);
  std::fflush(stdout);
  if (minutes == 0) return;
  const auto before = thread_seconds(host.id());
  const auto laying = Clock::now();
  while (since(laying) < 60 * minutes && host.running()) nap(1000);
  const double seconds = since(laying);
  const auto after = thread_seconds(host.id());
  kill(host.id(), SIGINT);
  host.wait();
  const json motion = printer.seen()["motion"];
  const json report = json::parse(test::read_text(printer.path("report.json")));
  fmt::print(
      "{:<16} {:.0f} s by the clock: starvations {}, {:.2f} s stopped in mid-curve; hurried layers {} of "
      "{}\n",
      name_of(job), seconds, motion["starvations"].get<int>(), motion["stopped_seconds"].get<double>(),
      report["effort"]["hurried_layers"].get<int>(), report["layer_count"].get<int>());
  for (const auto& [name, spent] : after) {
    const auto earlier = before.find(name);
    const double share = (spent - (earlier == before.end() ? 0 : earlier->second)) / seconds;
    fmt::print("{:<16} {:<10} {:>5.1f} % of a core\n", "", name, 100 * share);
  }
  double load = 0;
  if (getloadavg(&load, 1) == 1) fmt::print("{:<16} load of the whole computer: {:.1f}\n", "", load);
}

void measure(const std::string& word, double minutes, const std::vector<std::string>& jobs) {
  for (const std::string& job : jobs) {
    if (word.empty() || word == "starve") starve(job);
    if (word.empty() || word == "start" || word == "live") print(job, word == "start" ? 0 : minutes);
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> words(argv + 1, argv + argc);
  std::string word;
  double minutes = 1;
  if (!words.empty() && (words[0] == "starve" || words[0] == "start" || words[0] == "live")) {
    word = words[0];
    words.erase(words.begin());
  }
  if (word == "live" && !words.empty() && std::atof(words[0].c_str()) > 0) {
    minutes = std::atof(words[0].c_str());
    words.erase(words.begin());
  }
  if (words.empty()) words.push_back(UNICURSAL_EXAMPLES "/leaf.toml");
  try {
    measure(word, minutes, words);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}
