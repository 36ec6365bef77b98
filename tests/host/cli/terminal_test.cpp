// `unicursal print` in a real terminal: typed words, and Ctrl-C.
#include <catch2/catch.hpp>

#include "tests/host/support/daemon_process.hpp"
#include "tests/host/support/terminal.hpp"

using namespace unicursal;
using test::Child;
using test::Terminal;

TEST_CASE("a print is paused, changed, resumed and stopped from its terminal") {
  const test::TempFolder folder;
  folder.write("bench.toml", test::tall_profile());
  folder.write("plate.svg", test::sample_drawing);
  folder.write("job.toml", test::tall_job());
  const auto path = [&](const char* name) { return (folder / name).string(); };
  Child printer({"simulate", "--profile", path("bench.toml"), "--link", path("port"), "--speed", "100",
                 "--transcript", path("lines")});
  test::await([&] { return std::filesystem::exists(folder / "port"); }, printer);

  Terminal terminal({"print", path("job.toml"), "--port", path("port"), "--spool", path("spool")});
  terminal.await("printing layer 1");
  terminal.type("flow 5\n");
  terminal.await("not between 50 and 200");
  terminal.type("flow 95\n");
  terminal.type("pause\n");
  terminal.await("paused layer");
  terminal.type("what?\n");
  terminal.await("type pause, resume, cancel");
  terminal.type("resume\n");
  terminal.await("printing layer");
  terminal.type("\x03");
  terminal.await("a second Ctrl-C or `stop`");
  CHECK(terminal.wait() == 3);

  kill(printer.id(), SIGTERM);
  printer.wait();
  const std::string lines = test::read_text(folder / "lines");
  const auto at = [&](const char* line) { return lines.find(line); };
  REQUIRE(at("M221 S95") != std::string::npos);
  CHECK(at("M221 S95") < at("M400"));
  CHECK(lines.rfind("M104 S0") > lines.rfind("G1 X"));
}

TEST_CASE("a question of the printer is answered from the terminal") {
  const test::TempFolder folder;
  folder.write("bench.toml", test::sample_profile + std::string("\n[gcode]\nstart = \"M0\"\n"));
  folder.write("plate.svg", test::sample_drawing);
  folder.write("job.toml", test::sample_job);
  const auto path = [&](const char* name) { return (folder / name).string(); };
  Child printer({"simulate", "--profile", path("bench.toml"), "--link", path("port"), "--speed", "100",
                 "--personality", "marlin-host"});
  test::await([&] { return std::filesystem::exists(folder / "port"); }, printer);
  Terminal terminal({"print", path("job.toml"), "--port", path("port"), "--spool", path("spool")});
  terminal.await("the printer asks \"M0 Stop\": answer 0 (Continue)");
  terminal.type("answer 1.5\n");
  terminal.await("an answer is a number from 0 to 9");
  terminal.type("answer 7\n");
  terminal.await("7 is not one of its answers");
  terminal.type("answer 0\n");
  terminal.await("printing layer 1");
  CHECK(terminal.wait() == 0);
}

TEST_CASE("a print goes on to its end while its terminal is halted with Ctrl-S") {
  const test::TempFolder folder;
  folder.write("bench.toml", test::sample_profile);
  folder.write("plate.svg", test::sample_drawing);
  folder.write("job.toml", test::replaced(test::sample_job, "height = 0.4", "height = 2.0"));
  const auto path = [&](const char* name) { return (folder / name).string(); };
  Child printer({"simulate", "--profile", path("bench.toml"), "--link", path("port"), "--speed", "100",
                 "--transcript", path("lines")});
  test::await([&] { return std::filesystem::exists(folder / "port"); }, printer);

  Terminal terminal({"print", path("job.toml"), "--port", path("port"), "--spool", path("spool"), "--report",
                     path("report.json")});
  terminal.await("printing layer 1");
  terminal.type("\x13");
  // The report is written when the printer is parked and cooling, although nobody sees the screen.
  test::await([&] { return std::filesystem::exists(folder / "report.json"); }, printer);
  CHECK(test::read_text(folder / "lines").find("M104 S0") != std::string::npos);
  terminal.type("\x11");
  CHECK(terminal.wait() == 0);
}
