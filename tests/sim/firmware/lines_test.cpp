// Replies to good and bad lines (sim/README.md, "Marlin 2.1").
#include <catch2/catch.hpp>

#include "../bench.hpp"

using namespace unicursal::sim;
using Replies = Bench::Replies;

TEST_CASE("a board introduces itself") {
  Bench bench;
  bench.firmware.boot();
  CHECK(bench.send("M105").empty());  // input during the boot is lost
  bench.firmware.advance(2);
  REQUIRE(bench.replies.size() > 3);
  CHECK(bench.replies.front() == "start");
  CHECK(bench.replies[1] == "PowerUp");
  CHECK(std::find(bench.replies.begin(), bench.replies.end(), "Marlin 2.1.2.1") != bench.replies.end());
}

TEST_CASE("at boot a board can send host actions") {
  Bench bench("marlin-8bit");
  bench.firmware.boot();
  bench.firmware.advance(2);
  CHECK(bench.replies.back().starts_with("//action:"));
}

TEST_CASE("numbered lines are answered with ok") {
  Bench bench;
  CHECK(bench.send(1, "G90") == Replies{"ok"});
  CHECK(bench.send(2, "M83") == Replies{"ok"});
  CHECK(bench.firmware.counts().executed_in_order);
  CHECK(bench.firmware.last_line() == 2);
}

TEST_CASE("a damaged line is reported with the last good number, and requested again") {
  Bench bench;
  bench.send(1, "G90");
  CHECK(bench.send("N2 M83*1") == Replies{"Error:checksum mismatch, Last Line: 1", "Resend: 2", "ok"});
  CHECK(bench.send("N2 M83") ==
        Replies{"Error:No Checksum with line number, Last Line: 1", "Resend: 2", "ok"});
  CHECK(bench.send(5, "M83") ==
        Replies{"Error:Line Number is not Last Line Number+1, Last Line: 1", "Resend: 2", "ok"});
  CHECK(bench.send(2, "M83") == Replies{"ok"});
  CHECK(bench.firmware.counts().checksum_errors == 2);
  CHECK(bench.firmware.counts().number_errors == 1);
  CHECK(bench.firmware.counts().resends == 3);
}

TEST_CASE("the last two lines are dropped silently when they are sent again") {
  Bench bench;
  bench.send(1, "G90");
  bench.send(2, "M83");
  CHECK(bench.send(2, "M83").empty());
  CHECK(bench.send(1, "G90").empty());
  CHECK(bench.firmware.counts().repeated == 2);
  CHECK(bench.send(3, "G90") == Replies{"ok"});
  CHECK(bench.send(1, "G90").front().starts_with("Error:Line Number"));
}

TEST_CASE("an error flushes the receive buffer: lines in it vanish") {
  Bench bench;
  bench.firmware.receive(Bench::numbered(1, "G90") + "\nN2 M83*1\n" + Bench::numbered(3, "G91") + "\n");
  CHECK(bench.replies == Replies{"Error:checksum mismatch, Last Line: 1", "Resend: 2", "ok", "ok"});
  CHECK(bench.firmware.counts().received == 2);
  CHECK(bench.firmware.buffer().flushed() > 0);
}

TEST_CASE("lines that arrive after an error each raise their own, until the requested line arrives") {
  Bench bench;
  bench.send(1, "G90");
  bench.send("N2 M83*1");
  const Replies again{"Error:Line Number is not Last Line Number+1, Last Line: 1", "Resend: 2", "ok"};
  for (const int number : {3, 4, 5}) CHECK(bench.send(number, "M83") == again);
  CHECK(bench.send(2, "M83") == Replies{"ok"});
  CHECK(bench.firmware.counts().resends == 4);
}

TEST_CASE("an error is reported on receipt, before the oks of earlier lines") {
  Bench bench;
  bench.send(1, "G4 S5");
  bench.firmware.receive(Bench::numbered(2, "M105") + "\nN3 M105*1\n");
  CHECK(bench.replies == Replies{"Error:checksum mismatch, Last Line: 2", "Resend: 3", "ok"});
  bench.leap();
  CHECK(bench.replies.back().starts_with("ok T:"));
}

TEST_CASE("M110 sets the line number, in a numbered line and alone") {
  Bench bench;
  CHECK(bench.send("N0 M110 N0*" + std::to_string(checksum("N0 M110 N0"))) == Replies{"ok"});
  CHECK(bench.send(1, "G90") == Replies{"ok"});
  CHECK(bench.send("M110 N41") == Replies{"ok"});
  CHECK(bench.send(42, "G90") == Replies{"ok"});
  CHECK(bench.firmware.counts().executed_in_order);
}

TEST_CASE("M110 acts again when it is executed, so a line sent right after it is requested again") {
  Bench bench;
  bench.send("G4 P100");
  bench.firmware.receive("N0 M110 N0*125\n" + Bench::numbered(1, "G90") + "\n");
  bench.leap();
  CHECK(bench.firmware.last_line() == 0);
  CHECK(bench.send(2, "G90").front() == "Error:Line Number is not Last Line Number+1, Last Line: 0");
}

TEST_CASE("blank lines and comments get no ok") {
  Bench bench;
  CHECK(bench.send("").empty());
  CHECK(bench.send("; nothing").empty());
  CHECK(bench.send("   ").empty());
  CHECK(bench.firmware.counts().received == 0);
}

TEST_CASE("unknown commands are reported and acknowledged") {
  Bench bench;
  CHECK(bench.send("M9999") == Replies{"echo:Unknown command: \"M9999\"", "ok"});
  CHECK(bench.send("g28") == Replies{"echo:Unknown command: \"g28\"", "ok"});
  CHECK(bench.send(1, "FOO") == Replies{"echo:Unknown command: \"FOO\"", "ok"});
  CHECK(bench.send("T16") == Replies{"echo:T16 Invalid extruder", "ok"});
  CHECK(bench.firmware.counts().unknown == 3);
}

TEST_CASE("a line beyond 95 characters loses its checksum") {
  Bench bench;
  const std::string command = "M117 " + std::string(100, 'x');
  CHECK(bench.send(1, command).front() == "Error:No Checksum with line number, Last Line: 0");
  CHECK(bench.firmware.assembler().too_long() == 1);
}

TEST_CASE("bytes that a blocked printer cannot take are lost silently until the next newline") {
  Bench bench;
  bench.send(1, "G4 S10");
  std::string flood;
  for (int i = 2; i < 40; ++i) flood += Bench::numbered(i, "G4 P1") + "\n";
  CHECK(bench.send(flood).empty());
  CHECK(bench.firmware.buffer().lost() > 300);
  bench.leap();
  const auto done = bench.firmware.counts().executed;
  CHECK(done < 20);
  CHECK(bench.firmware.counts().resends == 0);
  CHECK(bench.send("").at(1).starts_with("Resend: "));
}

TEST_CASE("127 bytes in flight lose nothing, whatever the printer does") {
  Bench bench;
  bench.send(1, "G4 S10");
  std::string window;
  for (int i = 2; window.size() + 20 < 127; ++i) window += Bench::numbered(i, "G4 P1") + "\n";
  bench.send(window);
  CHECK(bench.firmware.buffer().lost() == 0);
}

TEST_CASE("nothing follows a kill") {
  Bench bench;
  CHECK(bench.send("M112") ==
        Replies{"echo:M112 Shutdown", "Error:Printer halted. kill() called!", "//action:poweroff"});
  CHECK(bench.send("M105").empty());
  CHECK(bench.firmware.killed());
  CHECK_FALSE(bench.firmware.next_event());
}

TEST_CASE("M112 behind a full queue is not read") {
  Bench bench;
  for (int i = 1; i <= 4; ++i) bench.send(i, "G4 S1");
  CHECK(bench.send("M112").empty());
  bench.leap();
  CHECK(bench.firmware.killed());
}
