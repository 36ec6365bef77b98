// How the personalities of Marlin differ from the plain one.
#include <catch2/catch.hpp>

#include "../bench.hpp"

using namespace unicursal::sim;
using Replies = Bench::Replies;

namespace {

/// Shares of the first three feeders in the fed filament.
std::array<double, 3> fed_shares(Bench& bench) {
  bench.firmware.run_down();
  const auto& steps = bench.firmware.planner().feeder_steps();
  const double sum = static_cast<double>(steps[0] + steps[1] + steps[2]);
  return {static_cast<double>(steps[0]) / sum, static_cast<double>(steps[1]) / sum,
          static_cast<double>(steps[2]) / sum};
}

void mix(Bench& bench, double a, double b, double c) {
  bench.finish(fmt::format("M163 S0 P{}", a));
  bench.finish(fmt::format("M163 S1 P{}", b));
  bench.finish(fmt::format("M163 S2 P{}", c));
  bench.finish("M164 S5");
  bench.finish("T5");
}

}  // namespace

TEST_CASE("ADVANCED_OK reports the line number and the free places in planner and queue") {
  Bench bench("marlin-advanced-ok");
  CHECK(bench.send("M83") == Replies{"ok P15 B3"});
  CHECK(bench.send(1, "G90") == Replies{"ok N1 P15 B3"});
  CHECK(bench.send(2, "G1 X10 F1200") == Replies{"ok N2 P14 B3"});
  CHECK(bench.send(3, "M105").front().starts_with("ok T:25.00 /0.00 B:25.00 /0.00 @:0 B@:0"));
  CHECK(bench.replies.front().find('P') == std::string::npos);
}

TEST_CASE("ADVANCED_OK counts down while the planner and then the queue fill up") {
  Bench bench("marlin-advanced-ok");
  for (int i = 1; i <= 15; ++i)
    CHECK(bench.send("G1 X" + std::to_string(i)).back() == fmt::format("ok P{} B3", 15 - i));
  for (int i = 16; i <= 19; ++i) CHECK(bench.send("G1 X" + std::to_string(i)).empty());
  bench.firmware.advance(*bench.firmware.planner().next_event());
  CHECK(bench.replies == Replies{"ok P0 B0"});
}

TEST_CASE("a refused line is answered with a plain ok, with or without ADVANCED_OK") {
  Bench bench("marlin-advanced-ok");
  CHECK(bench.send("N1 G28*0") == Replies{"Error:checksum mismatch, Last Line: 0", "Resend: 1", "ok"});
}

TEST_CASE("8-bit boards have mixtures in 128 parts: 0.01 becomes 0.78 %, and 0.005 becomes 0") {
  Bench bench("marlin-8bit");
  bench.heat();
  mix(bench, 0.01, 0.99, 0);
  bench.finish("M83");
  bench.finish("G1 X50 E50 F3000");
  CHECK(fed_shares(bench)[0] == Approx(1.0 / 129).epsilon(1e-3));

  Bench other("marlin-8bit");
  other.heat();
  mix(other, 0.005, 0.995, 0);
  other.finish("M83");
  other.finish("G1 X50 E50 F3000");
  CHECK(fed_shares(other)[0] == 0);
}

TEST_CASE("32-bit boards feed 10/1/0 as 4545/455 of 5000 steps, and retract in the same way") {
  Bench bench;
  bench.heat();
  mix(bench, 10, 1, 0);
  bench.finish("M83");
  bench.finish("G1 X50 E12.5 F1200");
  bench.firmware.run_down();
  const PerFeeder<std::int64_t> after = bench.firmware.planner().feeder_steps();
  CHECK(std::abs(after[0] - 4545) <= 1);
  CHECK(std::abs(after[1] - 455) <= 1);
  CHECK(after[2] == 0);
  bench.finish("G1 E-12.5 F1200");
  bench.firmware.run_down();
  CHECK(std::abs(bench.firmware.planner().feeder_steps()[0]) <= 2);
  CHECK(std::abs(bench.firmware.planner().feeder_steps()[1]) <= 2);
}

TEST_CASE("8-bit boards cannot step faster than 40 kHz") {
  const auto seconds = [](std::string_view who) {
    Machine machine;
    machine.limits.max_speed = {1000, 1000, 10, 50};
    machine.limits.max_acceleration = {1e5, 1e5, 100, 1e4};
    Bench bench(machine, who);
    bench.finish("M204 S100000");
    bench.finish("G1 X190 F60000");  // 1000 mm/s are 80 000 steps/s
    bench.firmware.run_down();
    return bench.sink.moves.at(0).end - bench.sink.moves.at(0).start;
  };
  CHECK(seconds("marlin-8bit") == Approx(2 * seconds("marlin")).epsilon(0.1));
}

TEST_CASE("M165 writes the current tool at once, and omitted letters are 0") {
  Bench bench;
  bench.heat();
  mix(bench, 0, 0, 1);
  CHECK(bench.finish("M165 A1 B3") == Replies{"ok"});
  bench.finish("M83");
  bench.finish("G1 X50 E10 F1200");
  CHECK(fed_shares(bench)[0] == Approx(0.25).epsilon(1e-3));
  CHECK(fed_shares(bench)[2] == 0);
}

TEST_CASE("M165 without a letter changes nothing, and fills the collector otherwise") {
  Bench bench;
  bench.heat();
  mix(bench, 0, 0, 1);
  bench.finish("M165");
  bench.finish("M83");
  bench.finish("G1 X50 E10 F1200");
  CHECK(fed_shares(bench)[2] == Approx(1));
  bench.finish("M165 A1 B3");
  bench.finish("M163 S0 P0");
  bench.finish("M164 S1");
  bench.finish("T1");
  bench.finish("G1 X60 E30 F1200");  // 10 mm of feeder 3, 30 mm of feeder 2
  CHECK(fed_shares(bench)[1] == Approx(0.75).epsilon(1e-3));
}

TEST_CASE("only a reset revives a killed board, tools, modes, targets and line numbers are lost") {
  Bench bench("marlin-8bit");
  bench.heat();
  bench.send(1, "M83");
  mix(bench, 0, 0, 1);
  bench.send("M112");
  CHECK(bench.send("M105").empty());
  bench.firmware.reset();
  CHECK(bench.send("M105").empty());
  CHECK(bench.firmware.counts().while_booting == 5);
  bench.firmware.advance(bench.firmware.now() + 2);
  REQUIRE(bench.replies.size() > 2);
  CHECK(bench.replies.front() == "start");
  CHECK(bench.send("M105").front().find("/0.00 B:") != std::string::npos);
  CHECK(bench.send(1, "G1 E5 F600").front() == "ok");  // numbers start from 1; the nozzle is still hot
  CHECK(bench.send(2, "G1 E5 F600").front() == "ok");  // E is absolute again
  bench.firmware.run_down();
  CHECK(bench.firmware.planner().feeder_steps()[0] == 5 * 400);  // T0 is pure again
}

TEST_CASE("after a reset in mid-print a board believes that it is at zero, until it is homed") {
  Bench bench;
  bench.finish("G28");
  bench.finish("G1 X50 Y40 F6000");
  bench.finish("M400");
  bench.firmware.reset();
  bench.firmware.advance(bench.firmware.now() + 2);
  CHECK(bench.finish("M114").front().starts_with("X:0.00 Y:0.00 Z:0.00 E:0.00 Count X:0 Y:0"));
  bench.finish("G1 X10 F6000");
  bench.finish("M400");
  CHECK(bench.sink.moves.back().to.x == Approx(60));
  bench.finish("G28");
  bench.finish("G1 X10 F6000");
  bench.finish("M400");
  CHECK(bench.sink.moves.back().to.x == Approx(10));
}

TEST_CASE("a reset also ends the hang of a mixture of zeros") {
  Bench bench;
  bench.heat();
  mix(bench, 0, 0, 0);
  bench.finish("M83");
  bench.send("G1 X20 E1 F600");
  bench.firmware.advance(bench.firmware.now() + 1);
  REQUIRE(bench.firmware.hung());
  CHECK(bench.send("M105").empty());
  bench.firmware.reset();
  bench.firmware.advance(bench.firmware.now() + 2);
  CHECK_FALSE(bench.firmware.hung());
  CHECK(bench.send("M105").size() == 1);
}

TEST_CASE("personalities have names") {
  for (const char* name : {"marlin", "marlin-8bit", "marlin-advanced-ok", "marlin-host", "marlin-few-tools",
                           "marlin-plain", "repetier", "repetier-0.92", "reprapfirmware"})
    CHECK(personality(name).name == name);
  CHECK_THROWS_WITH(personality("klipper"), Catch::Contains("marlin-8bit"));
}
