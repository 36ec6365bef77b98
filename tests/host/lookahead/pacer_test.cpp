#include "host/lookahead/pacer.hpp"

#include <catch2/catch.hpp>

namespace unicursal::host {

TEST_CASE("An island for which nothing waits has unlimited time") {
  CHECK(Pacer(2, 1).allowance(no_hurry, 60, 1) == no_hurry);
}

TEST_CASE("No island may take longer than until the nozzle needs it") {
  const Pacer pacer(4, 1);
  for (const double slack : {0.0, 0.5, 5.0, 50.0, 500.0}) {
    for (const double print : {0.1, 10.0, 1000.0}) {
      for (const double share : {0.01, 1.0}) {
        const double allowed = pacer.allowance(slack, print, share);
        CHECK(allowed >= 0);
        CHECK(allowed <= slack);
      }
    }
  }
  CHECK(pacer.allowance(-3, 60, 1) == 0);  // it is late already
}

TEST_CASE("With a short look-ahead layers take less than they print, so that it grows") {
  const Pacer pacer(1, 1);
  CHECK(pacer.allowance(10, 9, 1) < 9);
  CHECK(pacer.allowance(10, 9, 1) == Approx(3));  // a third of what is wanted ahead
  CHECK(pacer.allowance(30, 9, 1) == Approx(9));
  CHECK(pacer.allowance(130, 9, 1) > 9);  // a long one may shrink
}

TEST_CASE("Islands share a layer's time by area, and threads add to it") {
  const Pacer one(1, 1), two(2, 1);
  CHECK(one.allowance(30, 20, 0.25) == Approx(one.allowance(30, 20, 1) / 4));
  CHECK(two.allowance(30, 10, 0.5) == Approx(one.allowance(30, 10, 1)));
}

TEST_CASE("The longest tail counts, and on a slow computer it counts for more") {
  Pacer pacer(1, 1), slow(1, 8);
  CHECK(slow.tail(1000) == Approx(8 * pacer.tail(1000)));
  pacer.learn_tail(1000, 2);
  slow.learn_tail(1000, 16);
  CHECK(pacer.tail(1000) >= 2);
  CHECK(slow.tail(1000) == Approx(8 * pacer.tail(1000)));
  const double before = pacer.tail(500);
  pacer.learn_tail(1000, 0.1);
  CHECK(pacer.tail(500) == before);
}

TEST_CASE("The full number of steps is learnt from islands that were not shortened") {
  Pacer pacer(1, 1);
  pacer.learn_full(400);
  CHECK(pacer.part_of_full(100) == Approx(0.25));
  CHECK(pacer.part_of_full(1000) == 1);
  for (int i = 0; i < 50; ++i) pacer.learn_full(800);
  CHECK(pacer.part_of_full(100) == Approx(0.125).epsilon(0.01));
}

}  // namespace unicursal::host
