// Help and short answers, as a person reads them in terminals of several widths.
#include <algorithm>
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

const std::vector<std::string> commands{
    "inspect", "new",   "colours", "dry-run", "plan",  "curve",  "simulate", "setup", "ports",     "doctor",
    "tune",    "load",  "purge",   "unload",  "print", "resume", "history",  "serve", "queue",     "start",
    "status",  "pause", "answer",  "cancel",  "stop",  "set",    "token",    "keys",  "completion"};

/// What a command shows in a window of this many columns. Only its example, which people copy, may be wider.
std::string shown(const std::vector<std::string>& words, int columns) {
  std::size_t broken = 0;
  std::istringstream lines(run(words).out);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("  unicursal ")) broken += (line.size() - 1) / std::size_t(columns);
  }
  Terminal terminal(words, "/nonexistent", {static_cast<unsigned short>(columns)});
  CHECK(terminal.wait() == 0);
  CHECK(terminal.screen().broken_rows() == broken);
  return terminal.screen().text();
}

}  // namespace

TEST_CASE("help of every command fits its window, with an example, and options without their types",
          "[optimised]") {
  const int width = GENERATE(60, 80, 120);
  CHECK_THAT(shown({"--help"}, width), Contains("  dry-run") && Contains("  completion"));
  for (const std::string& command : commands) {
    INFO(command);
    const std::string help = shown({command, "--help"}, width);
    CHECK_THAT(help, Contains("Example:\n  unicursal " + command) || Contains("unicursal tune transition"));
    for (const char* suffix : {" TEXT REQUIRED", ":INT", ":FLOAT", " UINT", ":{", "Env:", "Excludes"})
      CHECK_THAT(help, !Contains(suffix));
  }
}

TEST_CASE("faults are listed by an option of their own") {
  const int width = GENERATE(60, 80, 120);
  for (const char* command : {"dry-run", "simulate"}) {
    CHECK_THAT(shown({command, "--help"}, width), Contains("--help-faults") && !Contains("bitflip:CHANCE"));
    // A job is not needed.
    CHECK_THAT(shown({command, "--help-faults"}, width),
               Contains("  bitflip:CHANCE") && Contains("  heaterfail"));
  }
}

TEST_CASE("ports lists what has hardware behind it, and says so if nothing has") {
  const std::vector<host::PortInfo> ports = host::list_ports();
  const int width = GENERATE(60, 80, 120);
  Terminal terminal({"ports"}, "/nonexistent", {static_cast<unsigned short>(width)});
  CHECK(terminal.wait() == 0);
  const std::string text = terminal.screen().text();
  if (ports.empty()) CHECK_THAT(text, Contains("no serial port found; "));
  for (const host::PortInfo& port : ports) {
    CHECK_THAT(text, Contains(port.path + "  "));
    CHECK((port.usb || host::has_chip(port.path)));
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
  const int width = GENERATE(60, 80, 120);
  const test::TempFolder folder;
  Terminal terminal({"serve", "--lan", "--listen", "0.0.0.0:0", "--state", (folder / "state").string(),
                     "--port", (folder / "port").string()},
                    "/nonexistent", {static_cast<unsigned short>(width)});
  terminal.await("listening on http://");
  terminal.await("█");
  terminal.await("on another computer:");
  terminal.await("unicursal status --daemon http://");  // people copy it, so it is not broken
  terminal.type("\x03");
  CHECK(terminal.wait() == 0);
  // The picture is not broken: its first row, light modules only, is as wide as all others.
  const std::vector<std::string> rows = terminal.screen().rows();
  const auto first =
      std::find_if(rows.begin(), rows.end(), [](const auto& row) { return row.starts_with("█"); });
  REQUIRE(first != rows.end());
  const auto modules = static_cast<std::ptrdiff_t>(first->size() / std::string("█").size());
  REQUIRE(rows.end() - first > modules / 2);
  for (auto row = first; row < first + modules / 2; ++row) CHECK(row->starts_with("█"));
}

TEST_CASE("an empty queue says so, and the jobs that can be added do not include profiles") {
  test::DaemonBench bench;
  bench.folder().write("jobs/printer.toml", test::sample_profile);
  bench.serve();
  for (const int width : {60, 80, 120}) {
    const std::string state = bench.path("state");
    CHECK_THAT(shown({"queue", "--state", state}, width), Contains("the queue is empty; "));
    CHECK_THAT(shown({"queue", "--jobs", "--state", state}, width),
               Contains("plate.toml\n") && !Contains("printer.toml"));
  }
}

TEST_CASE("a daemon on another computer is asked by its address and token") {
  test::DaemonBench bench;
  bench.serve();
  for (const int width : {60, 80, 120}) {
    const std::vector<std::string> daemon{"--daemon", "http://" + bench.host(), "--token", bench.token()};
    std::vector<std::string> words{"queue"};
    words.insert(words.end(), daemon.begin(), daemon.end());
    CHECK_THAT(shown(words, width), Contains("the queue is empty; "));
  }
}
