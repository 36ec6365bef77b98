// How long the lines of a print take to run.
#include "host/link/move_clock.hpp"

#include <catch2/catch.hpp>

using unicursal::host::MoveClock;

TEST_CASE("moves take their way by their feed rate, and other lines none or any time") {
  MoveClock clock;
  CHECK_FALSE(clock.seconds("G28"));
  CHECK_FALSE(clock.seconds("G1 X10 F600"));  // it is not known from where
  CHECK(clock.seconds("G1 X40 F600").value() == Approx(3));
  CHECK_FALSE(clock.seconds("G1 Y30"));
  CHECK(clock.seconds("G1 X0 Y0").value() == Approx(5));
  CHECK(clock.seconds("G1 X.001").value() == Approx(0.02));
  CHECK(clock.seconds("M83") == 0);
  CHECK(clock.seconds("G1 E-4 F240").value() == Approx(1));
  CHECK(clock.seconds("M220 S50") == 0);
  CHECK(clock.seconds("G1 E4").value() == Approx(2));
  CHECK(clock.seconds("M220 S100") == 0);
  CHECK(clock.seconds("G91") == 0);
  CHECK(clock.seconds("G1 X-3 F60").value() == Approx(3));
  CHECK(clock.seconds("G90") == 0);
  CHECK(clock.seconds("G1 X0").value() == Approx(2.999).epsilon(1e-3));
  for (const char* quick : {"T3", "M104 S200", "M106", "M163 S0 P1", "M164 S1", "M105", "M85 S10"})
    CHECK(clock.seconds(quick) == 0);
  for (const char* slow : {"M109 S200", "M400", "G4 S1", "M0", "M600", "FOO", "M"})
    CHECK_FALSE(clock.seconds(slow));
}
