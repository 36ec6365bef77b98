// Help and short answers, as a person reads them in terminals of several widths.
#include <catch2/catch.hpp>
#include <sstream>

#include "host/cli/qr_code.hpp"
#include "host/link/find_port.hpp"
#include "tests/host/support/daemon_process.hpp"
#include "tests/host/support/terminal.hpp"

using namespace unicursal;
using Catch::Matchers::Contains;
using test::run;
using test::Terminal;

namespace {

const std::vector<std::string> commands{"inspect", "new",   "dry-run", "plan",   "curve",     "simulate",
                                        "setup",   "ports", "doctor",  "tune",   "print",     "resume",
                                        "serve",   "queue", "start",   "status", "pause",     "answer",
                                        "cancel",  "stop",  "set",     "token",  "completion"};

}  // namespace

TEST_CASE("help fits a window of 60, 80 or 120 columns") {
  const int width = GENERATE(60, 80, 120);
  const std::vector<std::vector<std::string>> all{
      std::vector<std::string>{"--help"}, std::vector<std::string>{"print", "--help"},
      std::vector<std::string>{"simulate", "--help-faults"}, std::vector<std::string>{"queue", "--help"}};
  for (const std::vector<std::string>& words : all) {
    Terminal terminal(words, "/nonexistent", {static_cast<unsigned short>(width)});
    CHECK(terminal.wait() == 0);
    CHECK(terminal.screen().rows().size() > 10);
    CHECK(terminal.screen().broken_rows() == 0);
  }
}

TEST_CASE("every command has an example and options without suffixes of their types") {
  for (const std::string& command : commands) {
    INFO(command);
    const std::string help = run({command, "--help"}).out;
    CHECK_THAT(help, Contains("Example:\n  unicursal " + command) || Contains("unicursal tune transition"));
    for (const char* suffix : {" TEXT REQUIRED", ":INT", ":FLOAT", " UINT", ":{", "Env:", "Excludes"})
      CHECK_THAT(help, !Contains(suffix));
  }
}

TEST_CASE("faults are listed by an option of their own") {
  for (const char* command : {"dry-run", "simulate"}) {
    CHECK_THAT(run({command, "--help"}).out, Contains("--help-faults") && !Contains("bitflip:CHANCE"));
    const test::Outcome faults = run({command, "--help-faults"});  // a job is not needed
    CHECK(faults.code == 0);
    CHECK_THAT(faults.out, Contains("  bitflip:CHANCE  ") && Contains("  heaterfail  "));
  }
}

TEST_CASE("auto prefers what hangs on USB") {
  const std::vector<host::PortInfo> ports{{"/dev/ttyS0", "", "", false, {}},
                                          {"/dev/ttyUSB0", "", "", true, {}}};
  const auto meant = host::matching_ports(ports, "auto");
  REQUIRE(meant.size() == 1);
  CHECK(meant.front().path == "/dev/ttyUSB0");
}

TEST_CASE("a QR code is square, has its finders, and a border of four light modules") {
  const std::string code = host::qr_code("http://192.168.1.5:8377/");
  std::istringstream lines(code);
  std::vector<std::vector<std::string>> rows;
  for (std::string line; std::getline(lines, line);) {
    rows.emplace_back();
    for (std::size_t i = 0; i < line.size();) {
      const std::size_t size = line[i] == ' ' ? 1 : 3;
      rows.back().push_back(line.substr(i, size));
      i += size;
    }
  }
  REQUIRE(rows.size() > 2);
  const std::size_t modules = rows.front().size();
  CHECK((modules - 8 - 17) % 4 == 0);  // 17 + 4 · version, and the border
  CHECK(rows.size() == (modules + 1) / 2);
  for (const auto& row : rows) CHECK(row.size() == modules);
  for (std::size_t column = 0; column < modules; ++column) {
    CHECK(rows[0][column] == "█");
    CHECK(rows[1][column] == "█");
  }
  // The first finder: a dark frame of 7 modules, and a light one within.
  std::string top;
  for (std::size_t column = 4; column < 12; ++column) top += rows[2][column];
  CHECK(top == " ▄▄▄▄▄ █");
}

TEST_CASE("serve --lan shows its address as a QR code in a terminal") {
  const test::TempFolder folder;
  Terminal terminal({"serve", "--lan", "--listen", "0.0.0.0:0", "--state", (folder / "state").string(),
                     "--port", (folder / "port").string()});
  terminal.await("listening on http://");
  terminal.await("█");
  terminal.await("on another computer: unicursal status --daemon http://");
  terminal.type("\x03");
  CHECK(terminal.wait() == 0);
}

TEST_CASE("an empty queue says so, and the jobs that can be added do not include profiles") {
  test::DaemonBench bench;
  bench.folder().write("jobs/printer.toml", test::sample_profile);
  bench.serve();
  CHECK_THAT(bench.command({"queue"}).out, Contains("the queue is empty; "));
  CHECK_THAT(bench.command({"queue", "--jobs"}).out, Contains("plate.toml\n") && !Contains("printer.toml"));
}
