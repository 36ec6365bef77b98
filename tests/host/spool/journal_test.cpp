#include "host/spool/journal.hpp"

#include <catch2/catch.hpp>
#include <cstdlib>

#include "host/spool/spool_error.hpp"
#include "tests/host/support/temp_folder.hpp"

using namespace unicursal;
using namespace unicursal::host;

namespace {

/// Runs `write` on a new journal, closes it, and reads it.
template <class Write>
JournalState after(Write write) {
  const test::TempFolder folder;
  {
    Journal journal(folder / "journal", 0);
    write(journal);
  }
  return read_journal(folder / "journal");
}

}  // namespace

TEST_CASE("a journal records how far a print has got") {
  const JournalState state = after([](Journal& journal) {
    journal.begin_leg({});
    journal.begin_session();
    journal.anchor({1, 0}, true);
    for (std::uint64_t place = 16; place <= 160; place += 16) journal.progress(place, place - 5);
  });
  CHECK(state.legs == 1);
  CHECK(state.handed == 160);
  CHECK(state.acknowledged == 155);
  CHECK_FALSE(state.ended);
  CHECK(state.place_of(1) == 0);
  CHECK(state.place_of(120) == 119);
  CHECK_FALSE(state.place_of(0));
}

TEST_CASE("each line that the link inserts shifts only the numbers after it") {
  const JournalState state = after([](Journal& journal) {
    journal.begin_leg({});
    journal.anchor({1, 0}, true);
    journal.anchor({51, 49}, false);  // number 50 is a line of the link
    journal.anchor({61, 58}, false);  // number 60 is one, too
    journal.progress(70, 60);
  });
  CHECK(state.place_of(49) == 48);
  CHECK(state.place_of(50) == 49);  // lines up to 49 were executed: the link's line comes next, then place 49
  CHECK(state.place_of(51) == 49);
  CHECK(state.place_of(60) == 58);
  CHECK(state.place_of(61) == 58);
  CHECK(state.place_of(70) == 67);
}

TEST_CASE("numbers modulo 65536 mean the nearest line") {
  const JournalState state = after([](Journal& journal) {
    journal.begin_leg({});
    journal.anchor({1, 0}, true);
    journal.progress(131100, 131090);
  });
  CHECK(state.place_of(131095 % 65536) == 131094);
  CHECK(state.place_of(131095) == 131094);
  CHECK(state.place_of(65536 - 50) == 131072 - 51);
  const JournalState early = after([](Journal& journal) {
    journal.begin_leg({});
    journal.anchor({1, 0}, true);
    journal.progress(200, 190);
  });
  CHECK(early.place_of(195) == 194);
}

TEST_CASE("a new leg forgets the state of the previous one, and counts its lead-in") {
  const JournalState state = after([](Journal& journal) {
    journal.begin_leg({});
    journal.anchor({1, 0}, true);
    journal.progress(100, 90);
    journal.park({"M104 S0"});
    journal.end({LegOutcome::stopped, ""});
    journal.begin_leg({{"G28 X Y", "G92 Z1"}, 70, 0.4});
    journal.begin_session();
  });
  CHECK(state.legs == 2);
  CHECK(state.anchors.empty());
  CHECK(state.handed == 0);
  CHECK(state.parking.empty());
  CHECK_FALSE(state.ended);
  CHECK(state.leg.height == 0.4);
  CHECK(state.leg.line(0) == 70);
  CHECK(state.leg.line(2) == 70);
  CHECK(state.leg.line(5) == 73);
}

TEST_CASE("the end of a print is known until it is resumed") {
  const auto end = [](Journal& journal) {
    journal.begin_leg({});
    journal.end({LegOutcome::failed, "the cable was pulled"});
  };
  const JournalState state = after(end);
  REQUIRE(state.ended);
  CHECK(state.ended->outcome == LegOutcome::failed);
  CHECK(state.ended->reason == "the cable was pulled");
  CHECK_FALSE(after([&](Journal& journal) {
                end(journal);
                journal.begin_session();
              }).ended);
}

TEST_CASE("a journal that is continued keeps its contents, and loses a torn end") {
  const test::TempFolder folder;
  {
    Journal journal(folder / "journal", 0);
    journal.begin_leg({});
    journal.anchor({1, 0}, true);
    journal.progress(32, 16);
  }
  const std::string torn = test::read_text(folder / "journal") + "half a rec";
  const auto file = folder.write("journal", torn);
  std::uint64_t sound = 0;
  CHECK(read_journal(file, &sound).handed == 32);
  CHECK(sound == torn.size() - 10);
  { Journal(file, sound).progress(48, 40); }
  CHECK(read_journal(file).acknowledged == 40);
  CHECK(read_journal(file).anchors.size() == 1);
}

TEST_CASE("a sound record of a later version is refused with a message") {
  const test::TempFolder folder;
  const auto file = folder.write("journal", framed_record(std::string(1, '\x63')));
  CHECK_THROWS_WITH(read_journal(file), Catch::Contains("resume with the version"));
  CHECK_THROWS_AS(read_journal(folder / "nowhere"), SpoolError);
}
