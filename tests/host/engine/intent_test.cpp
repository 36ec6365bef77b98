// Whether a print goes on, is held, or ends.
#include <catch2/catch.hpp>

#include "host/engine/intent.hpp"

using namespace unicursal::host;

TEST_CASE("A pause lasts until it is ended, and nobody can ask for a second one meanwhile") {
  Intent intent;
  CHECK(intent.printing());
  intent.pause("first");
  intent.pause("second");
  CHECK(intent.paused_by_session());
  CHECK(intent.reason() == "first");
  intent.resume();
  CHECK(intent.pausing());
  CHECK_FALSE(intent.paused());
  intent.pause("third");
  CHECK_FALSE(intent.paused());
  intent.end_pause();
  CHECK(intent.printing());
  CHECK(intent.reason().empty());
  intent.resume();
  CHECK(intent.printing());
}

TEST_CASE("A pause that the firmware carries out is distinguished until it is over") {
  Intent intent;
  intent.pause("filament change", PausedBy::firmware);
  CHECK(intent.paused());
  CHECK_FALSE(intent.paused_by_session());
  CHECK(intent.paused_by_firmware());
  intent.resume();
  CHECK(intent.paused_by_firmware());
  intent.end_pause();
  CHECK_FALSE(intent.paused_by_firmware());
}

TEST_CASE("A stop ends a pause, and only an emergency stop can follow it") {
  Intent intent;
  intent.pause("held");
  intent.stop("the user");
  intent.resume();
  intent.end_pause();
  intent.pause("held again");
  intent.stop("the printer");
  CHECK(intent.stopped());
  CHECK(intent.ends());
  CHECK_FALSE(intent.pausing());
  CHECK(intent.reason() == "the user");
  intent.abort();
  intent.stop("the user");
  CHECK(intent.aborted());
  CHECK_FALSE(intent.stopped());
  CHECK(intent.ends());
}
