// Random input: the printer neither crashes nor hangs, and a reset always makes it work again.
#include <catch2/catch.hpp>

#include "hostile_life.hpp"

using namespace unicursal::sim;

TEST_CASE("the printer survives any input") {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    INFO("seed " << seed);
    CHECK_NOTHROW(live(seed));
  }
}
