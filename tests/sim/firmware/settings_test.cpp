// What firmwares answer that change nothing.
#include <catch2/catch.hpp>

#include "../bench.hpp"

using namespace unicursal::sim;
using Replies = Bench::Replies;

TEST_CASE("Marlin reports its settings, all of them and each by its own command") {
  Bench bench;
  const Replies all = bench.send("M503");
  CHECK(std::find(all.begin(), all.end(), "echo:  M92 X80.00 Y80.00 Z400.00 E400.00") != all.end());
  for (const auto& [ask, answer] : std::vector<std::pair<std::string, std::string>>{
           {"M92", "echo:  M92 X80.00 Y80.00 Z400.00 E400.00"},
           {"M113", "echo:M113 S2"},
           {"M220", "FR:100%"},
           {"M221", "echo:E0 Flow: 100%"},
           {"M301", "echo: P22.20 I1.08 D114.00"},
           {"M302", "echo:Cold extrudes are disabled (min temp 170.00C)"},
           {"M118 E1 hello", "echo:hello"},
           {"M118 A1 action:x", "//action:x"},
           {"M502", "echo:Hardcoded Default Settings Loaded"},
           {"M500", "Error:EEPROM disabled"}})
    CHECK(bench.send(ask) == Replies{answer, "ok"});
  for (const char* ask : {"M201", "M203", "M204", "M205", "M211", "M31", "M119"}) {
    CAPTURE(ask);
    CHECK(bench.send(ask).size() >= 2);
    CHECK(bench.replies.front().find("nknown") == std::string::npos);
  }
}

TEST_CASE("Homed axes go below 0 as far as the software endstops let them, and no further") {
  Machine machine;
  machine.overtravel = {2, 4};
  Bench bench(machine);
  CHECK(bench.send("M211").front().find("Min:  X-2.00 Y-4.00 Z0.00") != std::string::npos);
  bench.finish("G28");
  bench.finish("G1 X-1 Y-9 Z-1 F6000");
  CHECK(bench.finish("M114").front().starts_with("X:-1.00 Y:-4.00 Z:0.00"));
}

TEST_CASE("M113 changes how often a busy Marlin says so, and M302 what is too cold") {
  Bench bench;
  bench.send("M113 S0");
  bench.send("G4 S20");
  bench.replies.clear();
  bench.leap();
  CHECK(bench.replies == Replies{"ok"});
  bench.send("M302 S20");
  CHECK(bench.send("G1 E1 F600") == Replies{"ok"});
}

TEST_CASE("G92 reports the new position before its ok, and M999 asks for the next line") {
  Bench bench;
  CHECK(bench.send("G92 X7").front().starts_with("X:7.00 Y:0.00"));
  bench.send(1, "G90");
  CHECK(bench.send("M999") == Replies{"Resend: 2", "ok", "ok"});
}

TEST_CASE("M114 waits for the moves before it") {
  Bench bench;
  bench.send("G1 X60 F3600");
  CHECK(bench.send("M114").empty());
  bench.leap();
  CHECK(bench.replies.front().find("Count X:4800") != std::string::npos);
}

TEST_CASE("arcs end where they should, by centre and by radius, with their length and filament") {
  const auto [line, length] = GENERATE(table<std::string, double>({
      {"G2 X20 Y0 I10 J0 E2 F1200", 31.4159},
      {"G3 X20 Y0 I10 J0 E2 F1200", 31.4159},
      {"G2 X20 Y0 R10 E2 F1200", 31.4159},
      {"G3 X10 Y10 I0 J10 E2 F1200", 15.708},
      {"G2 I10 E2 F1200", 62.8319},
  }));
  CAPTURE(line);
  Bench bench;
  bench.heat();
  bench.finish("G1 Y50 F6000");
  bench.finish("M400");
  bench.finish("G92 Y0");
  const std::size_t before = bench.sink.moves.size();
  bench.finish(line);
  bench.firmware.run_down();
  double sum = 0, fed = 0;
  for (std::size_t i = before; i < bench.sink.moves.size(); ++i) {
    const ExecutedMove& move = bench.sink.moves[i];
    sum += std::hypot(move.to.x - move.from.x, move.to.y - move.from.y);
    fed += move.filament;
  }
  CHECK(sum == Approx(length).epsilon(0.01));
  CHECK(fed == Approx(2).epsilon(0.001));
}

TEST_CASE("a NUL ends a line, as a line feed does") {
  Bench bench;
  bench.firmware.receive(std::string_view("M118 a\0M118 b\n", 14));
  CHECK(bench.replies == Replies{"a", "ok", "b", "ok"});
}

TEST_CASE("Repetier: its own words") {
  Bench bench("repetier");
  CHECK(bench.send("N1 M110") == Replies{"ok"});
  CHECK(bench.send("M221 S90") == Replies{"ok 1", "FlowMultiply:90"});
  CHECK(bench.send("M220 S80") == Replies{"ok 1", "SpeedMultiply:80"});
  CHECK(bench.send("M106 S128") == Replies{"ok 1", "Fanspeed:128"});
  CHECK(bench.send("M104 S0") == Replies{"ok 1", "TargetExtr0:0"});
  CHECK(bench.send("T3") == Replies{"ok 1", "SelectExtruder:0"});
  CHECK(bench.send("M114") == Replies{"ok 1", "X:0.00 Y:0.00 Z:0.000 E:0.0000"});
  CHECK(bench.send("M501").back() == "Error:No EEPROM support compiled.");
  CHECK(bench.send(2, "M503").back() == "Unknown command:N2 M503 ");
  CHECK(bench.send("N3") == Replies{"ok 3"});
  const Replies who = bench.send("M115");
  CHECK(who[1].find("EXTRUDER_COUNT:3") != std::string::npos);
  CHECK(who[1].find("REPETIER_PROTOCOL:3") != std::string::npos);
  CHECK(who.size() == 2 + 11);
  CHECK(Bench("repetier-0.92").send("M115").size() == 2);
}

TEST_CASE(
    "Repetier: a numbered line without its checksum is taken, so a bracket can cost the rest of a line") {
  Bench bench("repetier");
  CHECK(bench.send("N1 G1 X5 F600") == Replies{"ok 1"});
  std::string line = Bench::numbered(2, "G1 X9 Y9");
  line.replace(line.find('Y'), 1, "(");
  CHECK(bench.send(line) == Replies{"ok 2"});
  CHECK(bench.send("M114").back() == "X:9.00 Y:0.00 Z:0.000 E:0.0000");
  CHECK(bench.send("N3 G1 X1*0").front() == "Error:Wrong checksum");
}
