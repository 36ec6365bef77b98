// How a Marlin waits for a person.
#include <catch2/catch.hpp>

#include "../bench.hpp"

using namespace unicursal::sim;
using Replies = Bench::Replies;

namespace {

std::size_t index_of(const Replies& replies, const std::string& line) {
  return static_cast<std::size_t>(std::find(replies.begin(), replies.end(), line) - replies.begin());
}

void wait(Bench& bench, double seconds) {
  bench.replies.clear();
  bench.firmware.advance(bench.firmware.now() + seconds);
}

}  // namespace

TEST_CASE("a mixing Marlin refuses a change of filament without a tool") {
  Bench bench("marlin-host");
  CHECK(bench.send("M600") == Replies{"echo:M600 E stepper not specified", "ok"});
}

TEST_CASE("a change of filament waits for a person, and then for a choice that M108 does not end") {
  Bench bench("marlin-host");
  CHECK(bench.send("M600 T0").front() == "//action:paused");
  wait(bench, 10);
  const Replies parked = bench.replies;
  CHECK(index_of(parked, "//action:prompt_begin Nozzle Parked") < parked.size());
  CHECK(parked.back() == "echo:busy: paused for user");
  CHECK(index_of(parked, "ok") == parked.size());
  for (int i = 0; i < 10; ++i) bench.send(i + 1, "G90");  // the queue is full, but M108 is seen
  bench.send("M108");
  wait(bench, 10);
  CHECK(index_of(bench.replies, "//action:prompt_button PurgeMore") + 1 ==
        index_of(bench.replies, "//action:prompt_button Continue"));
  bench.send("M108");
  wait(bench, 10);
  CHECK(bench.replies.back() == "echo:busy: paused for user");
  bench.send("M876 S0");
  wait(bench, 10);
  CHECK(index_of(bench.replies, "//action:prompt_begin Paused") < bench.replies.size());
  bench.send("M876 S1");
  wait(bench, 0.1);
  CHECK(bench.firmware.blocked() == false);
  CHECK(bench.firmware.last_line() > 3);
}

TEST_CASE("a Marlin without an emergency parser does not see M108 behind a full queue") {
  Bench bench;
  bench.send("M0");
  for (int i = 0; i < 3; ++i) bench.send("G90");
  bench.send("M108");
  wait(bench, 10);
  CHECK(bench.replies.back() == "echo:busy: paused for user");
  Bench other;
  other.send("M0");
  CHECK(other.send("M108") == Replies{"ok", "ok"});
}

TEST_CASE("a printer whose filament runs out gives itself the command, which nobody acknowledges") {
  Bench bench("marlin-host");
  bench.firmware.run_out("M600");
  CHECK(bench.replies.front() == "//action:out_of_filament T0");
  CHECK(bench.replies.back() == "echo:M600 E stepper not specified");
}

TEST_CASE("x and y are homed with the nozzle raised, which is only ever raised and stays there") {
  Bench bench("marlin-host");
  bench.finish("G28");
  bench.finish("G1 Z1 F600");
  bench.finish("G28 X Y");
  CHECK(bench.send("M114").front().starts_with("X:0.00 Y:0.00 Z:4.00"));
  bench.finish("G1 Z9 F600");
  bench.finish("G28 X");
  CHECK(bench.send("M114").front().find("Z:9.00") != std::string::npos);
  Bench stock;
  stock.finish("G28");
  stock.finish("G28 X");
  CHECK(stock.send("M114").front().find("Z:0.00") != std::string::npos);
}

TEST_CASE("a Marlin that must be homed first refuses moves of axes that were not") {
  Bench bench("marlin-host");
  CHECK(bench.send("G1 X5 Z1") == Replies{"echo:Home XZ First", "ok"});
  bench.finish("G28 X");
  CHECK(bench.send("G1 X5 F600").back() == "ok");
  CHECK(bench.send("G1 Y5") == Replies{"echo:Home Y First", "ok"});
  CHECK(bench.firmware.planner().planned_position()[axis_y] == 0);
}
