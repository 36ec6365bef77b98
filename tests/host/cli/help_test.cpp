// Help and short answers.
#include <catch2/catch.hpp>

#include "host/link/find_port.hpp"
#include "tests/host/support/daemon_process.hpp"

using namespace unicursal;
using Catch::Matchers::Contains;
using test::run;

namespace {

const std::vector<std::string> commands{"inspect", "new",   "dry-run", "plan",   "curve", "simulate",
                                        "setup",   "ports", "doctor",  "tune",   "print", "resume",
                                        "serve",   "queue", "start",   "status", "pause", "answer",
                                        "cancel",  "stop",  "set",     "token"};

}  // namespace

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

TEST_CASE("an empty queue says so, and the jobs that can be added do not include profiles") {
  test::DaemonBench bench;
  bench.folder().write("jobs/printer.toml", test::sample_profile);
  bench.serve();
  CHECK_THAT(bench.command({"queue"}).out, Contains("the queue is empty; "));
  CHECK_THAT(bench.command({"queue", "--jobs"}).out, Contains("plate.toml\n") && !Contains("printer.toml"));
}
