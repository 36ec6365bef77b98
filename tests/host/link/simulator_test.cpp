// The link with the project's own simulated printer, in a process of its own.
#include "sim/simulator.hpp"

#include <fmt/format.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <asio/co_spawn.hpp>
#include <asio/io_context.hpp>
#include <catch2/catch.hpp>
#include <exception>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "host/link/link.hpp"
#include "tests/host/support/temp_folder.hpp"

using namespace unicursal;
using namespace unicursal::host;

namespace {

/// A simulator in a child process, which the destructor ends.
class Simulator {
 public:
  explicit Simulator(const std::filesystem::path& report) {
    int pipe_ends[2];
    REQUIRE(::pipe(pipe_ends) == 0);
    child_ = ::fork();
    if (child_ == 0) {
      ::prctl(PR_SET_PDEATHSIG, SIGTERM);  // a test that crashes leaves no process behind
      ::_exit(simulate(report, pipe_ends[1]));
    }
    ::close(pipe_ends[1]);
    for (char c = 0; ::read(pipe_ends[0], &c, 1) == 1 && c != '\n';) path_ += c;
    ::close(pipe_ends[0]);
  }
  ~Simulator() {
    if (child_ > 0) ::kill(child_, SIGTERM);
    wait();
  }

  const std::string& path() const { return path_; }
  int wait() {
    int status = -1;
    if (child_ > 0) ::waitpid(child_, &status, 0);
    child_ = -1;
    return status;
  }

 private:
  static int simulate(const std::filesystem::path& report, int ready) {
    sim::SimulatorOptions options;
    options.report = report;
    options.once = true;
    try {
      return sim::run_simulator(options, [ready](const std::string& path) {
        const std::string line = path + "\n";
        [[maybe_unused]] const auto written = ::write(ready, line.data(), line.size());
      });
    } catch (...) {
      return 1;
    }
  }

  pid_t child_ = -1;
  std::string path_;
};

std::vector<std::string> print_job(std::size_t moves) {
  std::vector<std::string> lines = {
      "G28", "G90", "M83", "M104 S200", "M109 S200", "G1 Z0.2 F600", "G1 X10 Y10 F6000"};
  for (std::size_t i = 0; i < moves; ++i) {
    lines.push_back(
        fmt::format("G1 X{:.2f} Y{} E.0166 F1500", 10 + 0.005 * static_cast<double>(i), i % 2 ? 10.4 : 10.0));
  }
  return lines;
}

LinkStatistics send(const Simulator& simulator, const std::vector<std::string>& lines) {
  LinkStatistics statistics;
  asio::io_context loop;
  std::exception_ptr error;
  asio::co_spawn(
      loop,
      [&]() -> asio::awaitable<void> {
        LinkOptions options;
        options.boot = std::chrono::milliseconds(500);
        Link link(loop.get_executor(), open_port(simulator.path(), 250000), options);
        co_await link.connect();
        co_await link.send(lines);
        co_await link.drain();
        statistics = link.statistics();
        CHECK(link.firmware().find("Marlin") != std::string::npos);
      },
      [&](std::exception_ptr thrown) { error = thrown; });
  loop.run();
  if (error) std::rethrow_exception(error);
  return statistics;
}

/// Interrupts this process's system calls, 20 000 times a second.
class SignalStorm {
 public:
  SignalStorm() {
    struct sigaction nothing {};
    nothing.sa_handler = [](int) {};  // without SA_RESTART, as the handlers of an event loop are
    sigaction(SIGALRM, &nothing, &before_);
    const itimerval often{{0, 50}, {0, 50}};
    setitimer(ITIMER_REAL, &often, nullptr);
  }
  ~SignalStorm() {
    const itimerval never{};
    setitimer(ITIMER_REAL, &never, nullptr);
    sigaction(SIGALRM, &before_, nullptr);
  }

 private:
  struct sigaction before_ {};
};

}  // namespace

TEST_CASE("20 000 lines to the simulated printer: none is lost or executed twice") {
  const auto report_file =
      std::filesystem::temp_directory_path() / fmt::format("unicursal-link-{}.json", ::getpid());
  Simulator simulator(report_file);
  const auto lines = print_job(20000);
  const LinkStatistics statistics = send(simulator, lines);
  CHECK(simulator.wait() == 0);
  CHECK(statistics.acknowledged == lines.size());
  // A simulator that gets no processor for seconds is asked whether it lives, which takes a line of its own.
  const bool undisturbed = statistics.probes == 0;
  if (undisturbed) CHECK(statistics.sent == lines.size());
  CHECK(statistics.resends == 0);
  std::ifstream stream(report_file);
  const auto report = nlohmann::json::parse(stream);
  CHECK(report.at("executed_lines_in_order") == true);
  CHECK(report.at("lines").at("checksum_errors") == 0);
  if (undisturbed) CHECK(report.at("lines").at("number_errors") == 0);
  CHECK(report.at("lines").at("lost_bytes") == 0);
  if (undisturbed) CHECK(report.at("last_line") == lines.size());
  CHECK(report.at("extruded_mm").get<double>() == Approx(20000 * 0.0166).epsilon(1e-3));
  std::filesystem::remove(report_file);
}

TEST_CASE("signals that interrupt system calls are not taken for a lost printer") {
  const test::TempFolder folder;
  Simulator simulator(folder / "report.json");
  const auto lines = print_job(5000);
  LinkStatistics statistics;
  {
    const SignalStorm storm;
    REQUIRE_NOTHROW(statistics = send(simulator, lines));
  }
  CHECK(simulator.wait() == 0);
  CHECK(statistics.acknowledged == lines.size());
  CHECK_FALSE(statistics.cut);
}
