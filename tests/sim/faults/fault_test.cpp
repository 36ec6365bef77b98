#include "sim/faults/fault.hpp"

#include <catch2/catch.hpp>

#include <fstream>

#include "../folder.hpp"

using namespace unicursal::sim;
using Catch::Contains;

TEST_CASE("faults are parsed") {
  const Fault flips = parse_fault("bitflip:1e-4");
  CHECK(flips.kind == FaultKind::bit_flip);
  CHECK(flips.chance == 1e-4);
  CHECK_FALSE(flips.has_moment());

  const Fault stall = parse_fault("stall:2.5@t=60");
  CHECK(stall.seconds == 2.5);
  CHECK(*stall.time == 60);

  const Fault lost = parse_fault(" lostok@line=120 ");
  CHECK(*lost.line == 120);
  CHECK(lost.chance == 0);

  const Fault words = parse_fault("say://action:pause@command=G28");
  CHECK(words.text == "//action:pause");
  CHECK(*words.command == "G28");
  CHECK(parse_fault("fatal:a@b@t=1").text == "a@b");
}

TEST_CASE("a malformed fault is refused with the correct form") {
  CHECK_THROWS_WITH(parse_fault("gremlin:1"), Contains("bitflip") && Contains("gremlin"));
  CHECK_THROWS_WITH(parse_fault("bitflip"), Contains("chance"));
  CHECK_THROWS_WITH(parse_fault("bitflip:1.5"), Contains("from 0 to 1"));
  CHECK_THROWS_WITH(parse_fault("bitflip:nan"), Contains("from 0 to 1"));
  CHECK_THROWS_WITH(parse_fault("reset"), Contains("moment"));
  CHECK_THROWS_WITH(parse_fault("reset:3@t=1"), Contains("no value"));
  CHECK_THROWS_WITH(parse_fault("stall:soon@t=1"), Contains("seconds"));
  CHECK_THROWS_WITH(parse_fault("reset@noon"), Contains("@line=NUMBER"));
  CHECK_THROWS_WITH(parse_fault("reset@line=x"), Contains("number"));
  CHECK_THROWS_WITH(parse_fault("say:@t=1"), Contains("text"));
  CHECK_THROWS_WITH(parse_fault("slow:1@t=1"), Contains("no moment"));
  CHECK_THROWS_WITH(parse_fault("slowboot:20@t=1"), Contains("no moment"));
  CHECK_THROWS_WITH(parse_fault("silentwork:20@t=1"), Contains("command"));
}

TEST_CASE("a file of faults has comments, blank lines and a seed") {
  const FaultPlan plan = parse_faults("# noisy cable\nseed 42\n\nbitflip:1e-3  # often\r\nreset@line=7", "f");
  CHECK(plan.seed == 42);
  REQUIRE(plan.faults.size() == 2);
  CHECK(plan.faults[1].kind == FaultKind::reset);
  CHECK_THROWS_WITH(parse_faults("\n\nbitflop:1", "cable.txt"), Contains("cable.txt:3"));
  CHECK_THROWS_WITH(parse_faults("seed x", "cable.txt"), Contains("cable.txt:1"));
}

TEST_CASE("every kind has a name that can be parsed, and a line in the help") {
  const std::string help = fault_help();
  for (int i = 0; i <= static_cast<int>(FaultKind::chatty_work); ++i) {
    const auto kind = static_cast<FaultKind>(i);
    CHECK(help.find("  " + std::string(name(kind))) != std::string::npos);
  }
}

TEST_CASE("the message about a missing file names it") {
  CHECK_THROWS_WITH(read_faults("/nowhere/faults"), Contains("/nowhere/faults"));
}
