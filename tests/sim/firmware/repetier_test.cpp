#include <catch2/catch.hpp>

#include "../bench.hpp"

using namespace unicursal::sim;
using Replies = Bench::Replies;

namespace {

Bench repetier() {
  return Bench("repetier");
}

/// Feeder steps of the moves so far.
PerFeeder<std::int64_t> fed(const Bench& bench) {
  PerFeeder<std::int64_t> sum{};
  for (const ExecutedMove& move : bench.sink.moves) {
    for (std::size_t i = 0; i < max_feeders; ++i) sum[i] += move.feeder_steps[i];
  }
  return sum;
}

}  // namespace

TEST_CASE("Repetier: ok with the line's number comes on receipt, before the command's own output") {
  Bench bench = repetier();
  CHECK(bench.send(1, "M105") == Replies{"ok 1", "T:25.00 /0 B:25.00 /0"});
  CHECK(bench.send("M105") == Replies{"ok 1", "T:25.00 /0 B:25.00 /0"});
}

TEST_CASE("Repetier: the ok of heating and homing does not mean that they are done") {
  Bench bench = repetier();
  CHECK(bench.send(1, "M109 S200") == Replies{"ok 1", "TargetExtr0:200"});
  CHECK(bench.firmware.blocked());
  CHECK(bench.send(2, "G28") == Replies{"ok 2"});
  bench.leap();
  CHECK(bench.firmware.nozzle().temperature(bench.firmware.now()) > 190);
  CHECK(std::count(bench.replies.begin(), bench.replies.end(), "ok 2") == 1);
  CHECK(std::count(bench.replies.begin(), bench.replies.end(), "busy:processing") > 10);
  CHECK(std::count(bench.replies.begin(), bench.replies.end(), "echo:busy: processing") == 0);
}

TEST_CASE("Repetier: it says wait every idle second, but not while it works") {
  Bench bench = repetier();
  bench.firmware.advance(3.5);
  CHECK(bench.replies == Replies{"wait", "wait", "wait"});
  bench.send("G4 S10");
  bench.replies.clear();
  bench.firmware.advance(bench.firmware.now() + 9);
  CHECK(std::count(bench.replies.begin(), bench.replies.end(), "wait") == 0);
}

TEST_CASE("Repetier: it requests a line every 200 ms until it has it, each time with an ok") {
  Bench bench = repetier();
  bench.send(1, "G90");
  CHECK(bench.send("N2 M83*1") == Replies{"Error:Wrong checksum", "", "Resend:2", "ok"});
  CHECK(bench.send(3, "M83").empty());  // discarded: it is not the requested line
  bench.replies.clear();
  bench.firmware.advance(0.5);
  CHECK(bench.replies == Replies{"", "Resend:2", "ok", "", "Resend:2", "ok"});
  CHECK(bench.send(2, "M83") == Replies{"ok 2"});
  bench.replies.clear();
  bench.firmware.advance(0.9);
  CHECK(bench.replies.empty());
}

TEST_CASE("Repetier: up to forty repeated lines are answered with skip") {
  Bench bench = repetier();
  for (int i = 1; i <= 50; ++i) bench.send(i, "G90");
  CHECK(bench.send(50, "G90") == Replies{"skip 50", "ok"});
  CHECK(bench.send(11, "G90") == Replies{"skip 11", "ok"});
  CHECK(bench.send(10, "G90") == Replies{"", "Resend:51", "ok"});
  CHECK(bench.firmware.counts().skipped == 2);
}

TEST_CASE("Repetier: line numbers compare modulo 65536") {
  Bench bench = repetier();
  bench.send(65535, "M110");
  CHECK(bench.send(0, "G90") == Replies{"ok 0"});
  CHECK(bench.send(1, "G90") == Replies{"ok 1"});
  CHECK(bench.send(65538, "G90") == Replies{"ok 65538"});
}

TEST_CASE("Repetier: P of M163 is an integer") {
  Bench bench = repetier();
  bench.heat();
  for (const char* line : {"M163 S0 P0.9", "M163 S1 P30", "M163 S2 P70", "M83", "G1 X50 E10 F1200"})
    bench.finish(line);
  bench.firmware.run_down();
  const auto steps = bench.firmware.planner().feeder_steps();
  CHECK(steps[0] == 0);
  CHECK(static_cast<double>(steps[1]) == Approx(1200).margin(2));
  CHECK(static_cast<double>(steps[2]) == Approx(2800).margin(2));
}

TEST_CASE("Repetier: M163 acts on the running move and on the queued ones") {
  Bench bench = repetier();
  bench.heat();
  for (const char* line : {"M163 S0 P100", "M163 S1 P0", "M163 S2 P0", "M83"}) bench.finish(line);
  bench.send("G1 X50 E10 F1200");  // 2.5 s
  bench.send("G1 X100 E10");
  bench.firmware.advance(bench.firmware.now() + 1.25);
  for (const char* line : {"M163 S0 P0", "M163 S1 P100"}) bench.send(line);
  bench.firmware.run_down();
  const auto steps = fed(bench);
  CHECK(steps[0] + steps[1] + steps[2] == 8000);
  CHECK(static_cast<double>(steps[0]) == Approx(2000).margin(300));
  CHECK(steps[2] < 100);
  double filament = 0;
  for (const ExecutedMove& move : bench.sink.moves) filament += move.filament;
  CHECK(filament == Approx(20));
  CHECK(bench.sink.moves.back().to.x == 100);
}

TEST_CASE("Repetier: M164 needs S, T waits for motion, T16 is T0, undefined tools are equal parts") {
  Bench bench = repetier();
  bench.heat();
  for (const char* line :
       {"M163 S0 P0", "M163 S1 P0", "M163 S2 P1", "M164 S3", "M163 S2 P0", "M163 S0 P1", "M164"}) {
    bench.finish(line);
  }
  bench.send("G1 X50 F1200");
  bench.send("T3");
  CHECK(bench.firmware.blocked());
  bench.leap();
  CHECK(bench.firmware.planner().still());
  bench.finish("M83");
  bench.finish("G1 X60 E2");
  bench.firmware.run_down();
  CHECK(fed(bench) == PerFeeder<std::int64_t>{0, 0, 800});
  for (const char* tool : {"T7", "T16"}) {  // neither is defined
    bench.sink.moves.clear();
    bench.finish(tool);
    bench.finish("G1 X70 E3");
    bench.firmware.run_down();
    CHECK(fed(bench) == PerFeeder<std::int64_t>{400, 400, 400});
  }
}

TEST_CASE("Repetier: cold extrusion is prevented silently") {
  Bench bench = repetier();
  CHECK(bench.send("G1 X10 E5 F1200") == Replies{"ok 0"});
  bench.firmware.run_down();
  CHECK(bench.sink.moves.at(0).filament == 0);
}

TEST_CASE("Repetier: M112 reboots the board, which says start") {
  Bench bench = repetier();
  bench.heat();
  CHECK(bench.send("M112").empty());
  bench.firmware.advance(bench.firmware.now() + 1.6);
  CHECK(bench.replies.front() == "start");
  CHECK(bench.firmware.nozzle().target() == 0);
  CHECK(bench.firmware.counts().resets == 1);
}

TEST_CASE("Repetier: unknown commands") {
  Bench bench = repetier();
  CHECK(bench.send("M9999") == Replies{"ok 0", "Unknown command:M9999 "});
  CHECK(bench.send("M165 A1").back() == "Unknown command:M165 A1 ");
  CHECK(bench.send("M115").at(1).starts_with("FIRMWARE_NAME:Repetier_1.0.4"));
}

TEST_CASE(
    "Repetier: a line that begins with a byte from 0x80 is a binary packet, which swallows what follows") {
  Bench bench = repetier();
  bench.send(1, "G90");
  // Bits 1, 2, 3, 6 and 8: M and G of a byte each, X, E and F, and four bytes about the packet itself.
  bench.firmware.receive("\xce\x01 G1 X5*100\n.....");
  CHECK(bench.replies == Replies{"ok 1", "Error:Wrong checksum", "", "Resend:2", "ok"});
  bench.replies.clear();
  CHECK(bench.send(2, "G91").front() == "ok 2");
  bench.replies.clear();
  bench.firmware.receive("\x80\x90");  // version 2 with a text, whose length is still to come
  bench.firmware.receive(std::string("\0\0\x05", 3));
  bench.firmware.receive("hello!");
  CHECK(bench.replies.empty());
  bench.firmware.receive("XX");
  CHECK(bench.replies.front() == "Error:Wrong checksum");
}

TEST_CASE("Repetier: a line or packet that has begun and does not go on is asked for again") {
  Bench bench = repetier();
  bench.send(1, "G90");
  bench.replies.clear();
  const std::string beginning = GENERATE("N2 G1", "\xce\x01");
  bench.firmware.receive(beginning);
  bench.firmware.advance(bench.firmware.now() + 0.19);
  CHECK(bench.replies.empty());
  bench.firmware.advance(bench.firmware.now() + 0.02);
  CHECK(bench.replies == Replies{"", "Resend:2", "ok"});
  CHECK(bench.send(2, "G91").back() == "ok 2");
}

TEST_CASE("Repetier: too long a line is asked for again, and its rest is a line of its own") {
  Bench bench = repetier();
  bench.send(1, "G90");
  bench.replies.clear();
  bench.firmware.receive("N2 M117 " + std::string(88, 'a'));
  CHECK(bench.replies == Replies{"", "Resend:2", "ok"});
  bench.replies.clear();
  bench.firmware.receive("M105\n");
  CHECK(bench.replies == Replies{"ok 1", "T:25.00 /0 B:25.00 /0"});
  bench.replies.clear();
  bench.firmware.receive("N2 M117 " + std::string(80, 'a') + "\n");
  CHECK(bench.replies == Replies{"ok 2"});
}
