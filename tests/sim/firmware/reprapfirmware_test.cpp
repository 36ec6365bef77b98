// The facts of sim/README.md, "RepRapFirmware".
#include <catch2/catch.hpp>

#include "../bench.hpp"

using namespace unicursal::sim;

namespace {

using Replies = Bench::Replies;

Bench duet() {
  return Bench("reprapfirmware");
}

/// Homed, hot, tool 0 in use, relative filament.
void prepare(Bench& bench) {
  for (const char* line : {"T0 P0", "G28", "M109 S210", "M83"}) bench.finish(line);
  bench.replies.clear();
}

/// mm that each feeder has turned forwards.
std::array<double, 3> fed(const Bench& bench) {
  std::array<double, 3> mm{};
  for (std::size_t i = 0; i < mm.size(); ++i)
    mm[i] = static_cast<double>(bench.firmware.planner().feeder_steps()[i]) /
            bench.firmware.planner().limits().steps_per_mm[axis_e];
  return mm;
}

bool said(const Bench& bench, std::string_view part) {
  return std::any_of(bench.replies.begin(), bench.replies.end(),
                     [&](const std::string& line) { return line.find(part) != std::string::npos; });
}

}  // namespace

TEST_CASE(
    "RepRapFirmware: numbers are not compared, a checksum may be absent, a wrong one drops the line "
    "silently") {
  Bench bench = duet();
  CHECK(bench.send(7, "M83") == Replies{"ok"});
  CHECK(bench.send(3, "M83") == Replies{"ok"});
  CHECK(bench.send(3, "M83") == Replies{"ok"});
  CHECK(bench.send("N4 M82") == Replies{"ok"});
  CHECK(bench.send("N5 M83*1").empty());
  CHECK(bench.firmware.counts().checksum_errors == 1);
  CHECK(bench.firmware.counts().resends == 0);
}

TEST_CASE("RepRapFirmware: a line that has lost its newline takes the next one with it") {
  Bench bench = duet();
  const std::string merged = Bench::numbered(1, "G92 X5") + Bench::numbered(2, "G92 Y7");
  CHECK(bench.send(merged) == Replies{"ok"});
  CHECK(bench.send("M114").at(0).starts_with("X:5.000 Y:0.000"));
}

TEST_CASE("RepRapFirmware: several commands in a line have one ok, capitals do not matter") {
  Bench bench = duet();
  CHECK(bench.send("g92 x5 G92 Y7") == Replies{"ok"});
  CHECK(bench.send("m114").at(0).starts_with("X:5.000 Y:7.000"));
}

TEST_CASE("RepRapFirmware: words for what it does not know") {
  Bench bench = duet();
  CHECK(bench.send("M163 S0 P1") == Replies{"Warning: M163: Command is not supported", "ok"});
  CHECK(bench.send("M155 S1") == Replies{"Warning: M155: Command is not supported", "ok"});
  CHECK(bench.send("hello") == Replies{"Error: Bad command: hello", "ok"});
  CHECK(bench.send("M226") ==
        Replies{"Error: M226: use M226 and M601 only within a file being printed", "ok"});
  CHECK(bench.send("M85 S60") == Replies{"ok"});  // and nothing follows
  CHECK(bench.send("M115").at(0).starts_with("FIRMWARE_NAME: RepRapFirmware for Duet"));
}

TEST_CASE("RepRapFirmware: an axis that is not homed does not move, but may be told where it is") {
  Bench bench = duet();
  CHECK(bench.finish("G1 Z5 F600") == Replies{"Error: G1: insufficient axes homed", "ok"});
  CHECK(bench.sink.moves.empty());
  bench.finish("G92 Z1");
  CHECK(bench.finish("G1 Z5 F600") == Replies{"ok"});
  bench.firmware.run_down();
  CHECK(bench.sink.moves.size() == 1);
  CHECK(bench.finish("G0 X5 Z6") == Replies{"Error: G0: insufficient axes homed", "ok"});
  bench.finish("M84");
  CHECK(bench.finish("G1 Z5") == Replies{"Error: G1: insufficient axes homed", "ok"});
}

TEST_CASE("RepRapFirmware: the shares multiply E, and travel with each move") {
  Bench bench = duet();
  prepare(bench);
  CHECK(bench.send("M567 P0") == Replies{"Tool 0 mix ratios: 1.000:0.000:0.000", "ok"});
  bench.send("M567 P0 E0.5:0.25:0.25");
  bench.send("G1 X20 E4 F600");
  CHECK(bench.send("M567 P0 E0:0:0.5") == Replies{"ok"});  // while the move before still waits
  bench.send("G1 X40 E4");
  bench.firmware.run_down();
  CHECK(fed(bench)[0] == Approx(2).margin(0.01));
  CHECK(fed(bench)[1] == Approx(1).margin(0.01));
  CHECK(fed(bench)[2] == Approx(1 + 2).margin(0.01));  // half of 4 mm: not normalised
  CHECK(bench.firmware.warnings().contains("the shares of a mixture did not add up to one"));
}

TEST_CASE("RepRapFirmware: a mixture needs its tool and as many shares as the tool has drives") {
  Bench bench = duet();
  CHECK(bench.send("M567 P3") == Replies{"Error: M567: Invalid tool number", "ok"});
  CHECK(bench.send("M567 E1:0:0") == Replies{"Error: M567: No tool number given and no current tool", "ok"});
  CHECK(bench.send("M567 P0 E1:0") ==
        Replies{"Setting mix ratios - wrong number of E drives: M567 P0 E1:0", "ok"});
}

TEST_CASE("RepRapFirmware: T waits until all motion has ended") {
  Bench bench = duet();
  prepare(bench);
  bench.send("G1 X40 F600");
  CHECK(bench.send("T-1").empty());
  bench.leap();
  CHECK(bench.replies == Replies{"ok"});
  CHECK(bench.firmware.now() > 4);
  CHECK(bench.send("T") == Replies{"No tool is selected", "ok"});
  bench.send("G1 X50 E1");
  CHECK(said(bench, "Attempting to extrude with no tool selected"));
  CHECK(bench.send("M221 S90") == Replies{"Error: M221: No tool selected", "ok"});
}

TEST_CASE("RepRapFirmware: G90 leaves M83 alone, and M221 scales moves of the axes only") {
  Bench bench = duet();
  prepare(bench);
  bench.send("G90");
  bench.send("M221 S50");
  for (const char* line : {"G1 X10 E2 F600", "G1 X20 E2", "G1 E1"}) bench.send(line);
  bench.firmware.run_down();
  CHECK(fed(bench)[0] == Approx(2 * 0.5 + 2 * 0.5 + 1).margin(0.01));
}

TEST_CASE("RepRapFirmware: a cold tool is not driven, and says so at most every 4 s") {
  Bench bench = duet();
  for (const char* line : {"T0", "G28", "M83"}) bench.finish(line);
  bench.send("G1 X10 E1 F600");
  CHECK(said(bench, "Warning: Tool 0 was not driven because its heater temperatures were not high enough"));
  bench.send("G1 X20 E1");
  CHECK_FALSE(said(bench, "Warning"));
  bench.replies.clear();
  bench.firmware.run_down();
  bench.firmware.advance(bench.firmware.now() + 5);
  CHECK(said(bench, "Warning: Tool 0 was not driven"));
  CHECK(fed(bench)[0] == 0);
  CHECK(bench.firmware.coordinates().place()[0] == 20);
}

TEST_CASE("RepRapFirmware: a heater that fails is switched off, and everything else goes on") {
  Bench bench = duet();
  prepare(bench);
  bench.firmware.nozzle().break_down(bench.firmware.now(), Heater::Defect::open);
  bench.firmware.advance(bench.firmware.now() + 60);
  CHECK(said(bench, "Error: Heater 1 fault: exceeded allowed temperature excursion: target 210.0"));
  CHECK_FALSE(bench.firmware.killed());
  bench.finish("M109 S210");  // nothing to wait for
  CHECK(bench.replies.back() == "ok");
  bench.send("G1 X20 E1 F600");
  bench.firmware.run_down();
  CHECK(bench.firmware.coordinates().place()[0] == 20);
  CHECK(bench.firmware.nozzle().target() == 0);
  bench.send("M562");
  bench.send("M104 S200");
  CHECK(bench.firmware.nozzle().target() == 200);
}

TEST_CASE("RepRapFirmware: temperatures come every 2 s during long commands, from the first M105 on") {
  Bench bench = duet();
  CHECK(bench.send("M105").at(0).starts_with("ok T0:25.0 /0.0 B:"));
  CHECK(bench.send("T0").back() == "ok");
  CHECK(bench.send("M105").at(0).starts_with("ok T:25.0 /0.0 T0:25.0 /0.0 B:25.0"));
  bench.replies.clear();
  bench.firmware.advance(bench.firmware.now() + 10);
  CHECK(bench.replies.empty());  // idle
  bench.send("G4 S7");
  bench.firmware.advance(bench.firmware.now() + 6);
  CHECK(bench.replies.size() >= 3);
  CHECK(said(bench, "T:25.0 /0.0"));
}

TEST_CASE("RepRapFirmware: nothing is read while a command runs, not even M112") {
  Bench bench = duet();
  bench.send("G4 S30");
  CHECK(bench.send("M112").empty());
  bench.leap();
  CHECK(bench.replies == Replies{"ok", "Emergency Stop! Reset the controller to continue.", "ok"});
  CHECK(bench.send("G28") == Replies{"Error: G28: Machine is halted", "ok"});
  CHECK(bench.send("M105").at(0).starts_with("ok "));
  bench.finish("M999");
  bench.firmware.advance(bench.firmware.now() + 10);
  CHECK(said(bench, "is up and running."));
  CHECK(bench.finish("G28").back() == "ok");
}

TEST_CASE("RepRapFirmware: limits are in mm/min, and are reported for every drive") {
  Bench bench = duet();
  bench.send("M203 X6000 Y6000 Z300 E1200");
  CHECK(bench.firmware.planner().limits().max_speed[axis_x] == 100);
  CHECK(bench.send("M203").at(0) ==
        "Max speeds (mm/min): X: 6000.0, Y: 6000.0, Z: 300.0, E: 1200.0:1200.0:1200.0, min. speed 30.00");
  bench.send("M566 X600");
  CHECK(bench.firmware.planner().limits().jerk[axis_x] == 10);
  CHECK(bench.send("M92").at(0) == "Steps/mm: X: 80.000, Y: 80.000, Z: 400.000, E: 400.000:400.000:400.000");
}
