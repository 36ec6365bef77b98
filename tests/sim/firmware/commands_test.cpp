#include <catch2/catch.hpp>

#include <cmath>
#include <numeric>

#include "../bench.hpp"

using namespace unicursal::sim;
using Replies = Bench::Replies;

namespace {

double filament(const MoveList& list) {
  double sum = 0;
  for (const auto& move : list.moves) sum += move.filament;
  return sum;
}

PerFeeder<std::int64_t> feeder_steps(Bench& bench) {
  bench.firmware.run_down();
  return bench.firmware.planner().feeder_steps();
}

}  // namespace

TEST_CASE("a move is acknowledged when it is planned: the sixteenth waits for a free block") {
  Bench bench;
  for (int i = 1; i <= 15; ++i) REQUIRE(bench.send("G1 X" + std::to_string(i) + " F1200") == Replies{"ok"});
  CHECK(bench.firmware.now() == 0);
  CHECK(bench.send("G1 X16").empty());
  REQUIRE(bench.firmware.blocked());
  const double first_end = *bench.firmware.planner().next_event();
  bench.firmware.advance(first_end - 1e-6);
  CHECK(bench.replies.empty());
  bench.firmware.advance(first_end);
  CHECK(bench.replies == Replies{"ok"});
  CHECK(bench.sink.moves.size() == 1);
  CHECK(bench.firmware.planner().queued() == 15);
}

TEST_CASE("M105 waits behind a move that waits") {
  Bench bench;
  for (int i = 1; i <= 16; ++i) bench.send("G1 X" + std::to_string(i));
  CHECK(bench.send("M105").empty());
  bench.leap();
  REQUIRE(bench.replies.size() == 2);
  CHECK(bench.replies[0] == "ok");
  CHECK(bench.replies[1].starts_with("ok T:25.00 /0.00 B:25.00 /0.00 @:0 B@:0"));
}

TEST_CASE("temperatures") {
  Bench bench;
  CHECK(bench.send("M105") == Replies{"ok T:25.00 /0.00 B:25.00 /0.00 @:0 B@:0"});
  CHECK(bench.send("M105 T3") == Replies{"echo:M105 Invalid extruder 3"});
  CHECK(bench.send("M104 S210") == Replies{"ok"});
  CHECK(bench.send("M140 S60") == Replies{"ok"});
  CHECK(bench.send("M105") == Replies{"ok T:25.00 /210.00 B:25.00 /60.00 @:127 B@:127"});
}

TEST_CASE("M109 reports every second until the nozzle is hot and has stayed hot") {
  Bench bench;
  bench.finish("M109 S210");
  CHECK(bench.replies.back() == "ok");
  CHECK(bench.firmware.nozzle().temperature(bench.firmware.now()) == Approx(210).margin(1));
  std::size_t waiting = 0, staying = 0, busy = 0;
  for (const auto& line : bench.replies) {
    if (line == "echo:busy: processing") ++busy;
    if (line.starts_with(" T:")) ++(line.ends_with(" W:?") ? waiting : staying);
  }
  CHECK(staying == 10);
  CHECK(static_cast<double>(waiting + staying) == Approx(bench.firmware.now()).margin(1));
  CHECK(busy == static_cast<std::size_t>(bench.firmware.now() / 2));
  CHECK(std::count(bench.replies.begin(), bench.replies.end(), "ok") == 1);
}

TEST_CASE("M109 S does not wait for cooling, R does") {
  Bench bench;
  bench.heat();
  CHECK(bench.send("M109 S180") == Replies{"ok"});
  CHECK(bench.send("M109 R200").empty());
  bench.leap();
  CHECK(bench.send("M109 R0").empty());
  bench.leap();
  CHECK(bench.firmware.nozzle().temperature(bench.firmware.now()) < 26);
}

TEST_CASE("M108 ends the wait of M109, and both get their ok") {
  Bench bench;
  CHECK(bench.send("M109 S210").empty());
  CHECK(bench.send("M108") == Replies{"ok", "ok"});
  CHECK(bench.firmware.now() == 0);
}

TEST_CASE("M155 reports automatically, between other lines") {
  Bench bench;
  bench.send("M155 S2");
  bench.replies.clear();
  bench.firmware.advance(7);
  CHECK(bench.replies == Replies(3, " T:25.00 /0.00 B:25.00 /0.00 @:0 B@:0"));
  bench.send("M155 S0");
  bench.replies.clear();
  bench.firmware.advance(20);
  CHECK(bench.replies.empty());
}

TEST_CASE("cold extrusion is prevented, but x and y move and E advances") {
  Bench bench;
  CHECK(bench.send("G1 X10 E5 F1200") == Replies{"echo: cold extrusion prevented", "ok"});
  CHECK(bench.finish("M114").front().starts_with("X:10.00 Y:0.00 Z:0.00 E:5.00"));
  bench.firmware.run_down();
  REQUIRE(bench.sink.moves.size() == 1);
  CHECK(bench.sink.moves[0].to.x == 10);
  CHECK(bench.sink.moves[0].filament == 0);
  CHECK(bench.firmware.warnings().at("cold extrusion prevented") == 1);
}

TEST_CASE("more than 200 mm of filament in one move is refused") {
  Bench bench;
  bench.heat();
  CHECK(bench.send("G1 X10 E200.5 F1200") == Replies{"echo: too long extrusion prevented", "ok"});
  CHECK(bench.send("G1 X20 E201 F1200") == Replies{"ok"});
  bench.firmware.run_down();
  CHECK(filament(bench.sink) == Approx(0.5));
}

TEST_CASE("G90 and G91 override M82 and M83") {
  Bench bench;
  bench.heat();
  for (const char* line : {"M83", "G90", "G1 X10 E2", "G1 X20 E2", "M83", "G1 X30 E2"}) bench.finish(line);
  bench.firmware.run_down();
  CHECK(filament(bench.sink) == Approx(4));
  CHECK(bench.sink.moves.back().to.x == 30);
}

TEST_CASE("relative moves, inches and a shifted origin") {
  Bench bench;
  for (const char* line : {"G91", "G1 X5 Y1", "G1 X5", "G90", "G92 X100", "G1 X110", "G20", "G1 Y1"})
    bench.finish(line);
  CHECK(bench.finish("M114").front().starts_with("X:110.00 Y:25.40"));
  bench.firmware.run_down();
  CHECK(bench.sink.moves.back().to.x == Approx(20));
  CHECK(bench.sink.moves.back().to.y == Approx(25.4));
}

TEST_CASE("M220 scales speed, M221 scales filament, but not the E of M114") {
  Bench bench;
  bench.heat();
  bench.finish("M83");
  bench.finish("G1 X100 E4 F1200");
  bench.finish("M400");
  bench.finish("M220 S50");
  bench.finish("M221 S150");
  bench.finish("G1 X0 E4 F1200");
  bench.finish("M400");
  CHECK(bench.finish("M114").front().find("E:8.00") != std::string::npos);
  bench.firmware.run_down();
  REQUIRE(bench.sink.moves.size() == 2);
  const auto seconds = [&](std::size_t i) { return bench.sink.moves[i].end - bench.sink.moves[i].start; };
  CHECK(seconds(0) == Approx(5).epsilon(0.01));
  CHECK(seconds(1) == Approx(10).epsilon(0.01));
  CHECK(bench.sink.moves[1].filament == Approx(6));
}

TEST_CASE("homing takes time and reports the position, afterwards the bed has edges") {
  Bench bench;
  bench.finish("G1 X50 Y50 F6000");
  const Replies replies = bench.finish("G28");
  REQUIRE(replies.size() >= 2);
  CHECK(replies[replies.size() - 2] == "X:0.00 Y:0.00 Z:0.00 E:0.00 Count X:0 Y:0 Z:0");
  CHECK(replies.back() == "ok");
  CHECK(bench.firmware.now() > 1);
  bench.finish("G1 X250 Y-3");
  bench.finish("M400");
  CHECK(bench.finish("M114").front().starts_with("X:200.00 Y:0.00"));
  CHECK(bench.firmware.warnings().size() == 1);
}

TEST_CASE("M400 and G4 are acknowledged when all motion has ended") {
  Bench bench;
  bench.send("G1 X60 F3600");
  CHECK(bench.send("M400").empty());
  bench.leap();
  CHECK(bench.firmware.planner().still());
  const double before = bench.firmware.now();
  bench.finish("G4 P1500");
  CHECK(bench.firmware.now() == Approx(before + 1.5));
}

TEST_CASE("a running command reports busy every two seconds") {
  Bench bench;
  CHECK(bench.finish("G4 S5") == Replies{"echo:busy: processing", "echo:busy: processing", "ok"});
}

TEST_CASE("M410 acknowledges a blocked move first, then itself, the rest of the queue is dropped") {
  Bench bench;
  for (int i = 1; i <= 16; ++i) bench.send("G1 X" + std::to_string(10 * i) + " F1200");
  bench.firmware.advance(0.4);
  CHECK(bench.send("M410") == Replies{"ok", "ok"});
  CHECK(bench.firmware.planner().still());
  CHECK(bench.sink.moves.size() == 1);
  CHECK(bench.sink.moves[0].to.x < 10);
  CHECK(bench.firmware.coordinates().logical(axis_x) == Approx(bench.sink.moves[0].to.x));
}

TEST_CASE("M115 reports the firmware and its capabilities") {
  Bench bench;
  const Replies replies = bench.send("M115");
  CHECK(replies.front().starts_with("FIRMWARE_NAME:Marlin 2.1.2"));
  CHECK(std::find(replies.begin(), replies.end(), "Cap:AUTOREPORT_TEMP:1") != replies.end());
  CHECK(replies.size() == 1 + 35 + 1);
  for (const std::string& reply : replies) CHECK(reply.find("BUSY_PROTOCOL") == std::string::npos);
  CHECK(replies.back() == "ok");
}

TEST_CASE("M85 switches an inactive printer off") {
  Bench bench;
  bench.heat();
  bench.finish("M85 S30");
  bench.replies.clear();
  const double asked = bench.firmware.now();
  bench.firmware.advance(asked + 29);
  CHECK_FALSE(bench.firmware.killed());
  bench.firmware.advance(asked + 31);
  CHECK(bench.firmware.killed());
  CHECK(bench.firmware.nozzle().target() == 0);
}

TEST_CASE("at power-up the first tools are pure, and the others are feeder 1") {
  const auto [tool, feeder] = GENERATE(table<int, std::size_t>({{0, 0}, {1, 1}, {2, 2}, {3, 0}, {15, 0}}));
  Bench bench;
  bench.heat();
  bench.finish("M83");
  bench.finish("T" + std::to_string(tool));
  bench.finish("G1 X10 E1 F600");
  PerFeeder<std::int64_t> expected{};
  expected[feeder] = 400;
  CHECK(feeder_steps(bench) == expected);
}

TEST_CASE("M163 and M164 define a mixture, whatever the scale of P") {
  const auto scale = GENERATE(0.01, 1.0, 100.0);
  Bench bench;
  bench.heat();
  bench.finish("M83");
  bench.finish("M163 S0 P" + fmt::format("{:.4f}", 10 * scale));
  bench.finish("M163 S1 P" + fmt::format("{:.4f}", scale));
  bench.finish("M163 S2 P-4");
  bench.finish("M164 S5");
  bench.finish("T5");
  bench.finish("G1 X100 E12.5 F600");
  const auto steps = feeder_steps(bench);
  CHECK(steps[0] == Approx(4545).margin(1));
  CHECK(steps[1] == Approx(455).margin(1));
  CHECK(steps[2] == 0);
}

TEST_CASE("the collector persists, and M164 without S stores into the current tool") {
  Bench bench;
  bench.heat();
  bench.finish("M83");
  for (const char* line : {"M163 S0 P1", "M163 S1 P1", "M164 S4", "M163 S2 P2", "T6", "M164"})
    bench.finish(line);
  bench.finish("G1 X100 E10 F600");
  CHECK(feeder_steps(bench) == PerFeeder<std::int64_t>{1000, 1000, 2000});
}

TEST_CASE("a mixture is copied into each move when the move is planned") {
  Bench bench;
  bench.heat();
  bench.finish("M83");
  bench.finish("G1 X10 E1 F600");
  for (const char* line : {"M163 S0 P0", "M163 S1 P1", "M163 S2 P0", "M164 S0"}) bench.finish(line);
  bench.finish("G1 X20 E1 F600");
  CHECK(bench.sink.moves.empty());  // both still in the queue
  CHECK(feeder_steps(bench) == PerFeeder<std::int64_t>{400, 400, 0});
}

TEST_CASE(
    "a feeder or a tool that is not there is ignored with a plain ok, a negative one is worth a warning") {
  Bench bench;
  bench.heat();
  bench.finish("M83");
  bench.finish("M163 S0 P1");
  for (const char* line : {"M163 S7 P9", "M163 S-1 P9", "M164 S16", "M164 S-1"})
    CHECK(bench.finish(line) == Replies{"ok"});
  CHECK(bench.firmware.warnings().size() == 1);
  bench.finish("M164 S1");
  bench.finish("T1");
  bench.finish("G1 X50 E10 F600");
  CHECK(feeder_steps(bench) == PerFeeder<std::int64_t>{4000, 0, 0});
}

TEST_CASE("a change of tools costs no stop") {
  const auto seconds = [](const char* between) {
    Bench bench;
    bench.heat();
    bench.finish("M83");
    for (int i = 1; i <= 10; ++i) {
      bench.finish(fmt::format("G1 X{} E0.3 F1800", 5 * i));
      bench.finish(fmt::format(fmt::runtime(between), i % 3));
    }
    bench.firmware.run_down();
    return bench.sink.moves.back().end - bench.sink.moves.front().start;
  };
  CHECK(seconds("T{}") == seconds("M117 {}"));
}

TEST_CASE("a mixture of zeros hangs the firmware") {
  Bench bench;
  bench.heat();
  bench.finish("M83");
  for (const char* line : {"M163 S0 P0", "M163 S1 P0", "M163 S2 P0", "M164 S0", "G1 X20 E1 F600"})
    bench.finish(line);
  bench.finish("M400");
  CHECK(bench.firmware.hung());
  CHECK(bench.send("M105").empty());
}

TEST_CASE("the steps of all feeders add up to E") {
  Bench bench;
  bench.heat();
  for (const char* line : {"M83", "M163 S0 P0.31", "M163 S1 P0.02", "M163 S2 P0.67", "M164 S0"})
    bench.finish(line);
  double asked = 0;
  for (int i = 0; i < 2000; ++i) {
    const double e = 0.0137 + 0.00001 * (i % 7);
    asked += e;
    bench.finish(fmt::format("G1 X{:.3f} Y{:.3f} E{:.5f} F1200", 50 + 40 * std::sin(i * 0.01),
                             50 + 40 * std::cos(i * 0.01), e));
  }
  const auto steps = feeder_steps(bench);
  const auto sum = std::accumulate(steps.begin(), steps.end(), std::int64_t{0});
  CHECK(static_cast<double>(sum) == Approx(asked * 400).margin(6));
  CHECK(static_cast<double>(steps[1]) == Approx(0.02 * asked * 400).margin(3));
  CHECK(filament(bench.sink) == Approx(asked).epsilon(1e-9));  // the laid filament is not rounded to steps
}

TEST_CASE("it does not matter how the bytes are cut into pieces") {
  const auto portion = GENERATE(std::size_t{1}, std::size_t{7}, std::size_t{60}, std::size_t{120});
  std::string bytes = "M109 S200\nM83\n";
  for (int i = 0; i < 300; ++i) bytes += fmt::format("G1 X{} Y{} E0.1 F1800\n", 20 + i % 7, 30 + i % 11);
  const auto run = [&bytes](std::size_t size) {
    Bench bench;
    for (std::size_t at = 0; at < bytes.size(); at += size) {
      bench.firmware.receive(std::string_view(bytes).substr(at, size));
      bench.leap();
    }
    bench.firmware.run_down();
    return std::pair(bench.replies, bench.sink.moves);
  };
  const auto [replies, moves] = run(portion);
  const auto [expected_replies, expected_moves] = run(16);
  CHECK(replies == expected_replies);
  REQUIRE(moves.size() == expected_moves.size());
  for (std::size_t i = 0; i < moves.size(); ++i) {
    CHECK(moves[i].start == expected_moves[i].start);
    CHECK(moves[i].end == expected_moves[i].end);
    CHECK(moves[i].feeder_steps == expected_moves[i].feeder_steps);
  }
}

TEST_CASE("hostile numbers do no harm") {
  Bench bench;
  bench.heat();
  for (const char* line :
       {"G91", "G1 X999999999999 F0.000001", "G1 X-99999999999999999 E199 F999999999999",
        "M92 X0.0000001 E999999999", "G1 X1 E100", "M205 X0 Y-1", "M201 X-5", "M203 X0.00001", "M204 S-3",
        "M220 S-99", "M221 S99999999", "G1 X5 E1", "G4 P-7", "M109 S99999", "M163 S-1 P1", "M163 S7 P1",
        "M164 S-3", "M155 S-1", "M110 N99999999999"}) {
    bench.finish(line);
  }
  bench.firmware.run_down();
  CHECK_FALSE(bench.firmware.hung());
  CHECK(std::isfinite(bench.firmware.now()));
}
