// The head strikes what it has laid.
#include "sim/bed/strikes.hpp"

#include <catch2/catch.hpp>

using namespace unicursal::sim;

namespace {

/// A wall along x from 50 to 60, `height` high.
Strikes wall(const std::optional<HeadShape>& head, double height) {
  Strikes strikes(head);
  for (double z = 0.25; z <= height; z += 0.25) strikes.laid({50, 50, z}, {60, 50, z});
  return strikes;
}

}  // namespace

TEST_CASE("the nozzle strikes a wall that it passes through, and not one that it passes above or beside") {
  Strikes strikes = wall(std::nullopt, 5);
  CHECK(strikes.by_nozzle() == 0);  // a part grows under the nozzle
  strikes.travelled({55, 40, 5}, {55, 60, 5});
  strikes.travelled({70, 40, 1}, {70, 60, 1});
  CHECK(strikes.by_nozzle() == 0);
  CHECK_FALSE(strikes.first());
  strikes.travelled({55, 40, 4.5}, {55, 60, 4.5});
  strikes.laid({40, 50, 0.25}, {70, 50, 0.25});
  CHECK(strikes.by_nozzle() == 2);
  REQUIRE(strikes.first());
  CHECK(strikes.first()->z == 4.5);
}

TEST_CASE("the head strikes within its radius, and everywhere with what is above its height") {
  const HeadShape head{20, 8};
  Strikes low = wall(head, 5);
  low.laid({60, 71, 0.25}, {50, 71, 0.25});
  CHECK(low.by_head() == 0);
  low.laid({60, 69, 0.25}, {50, 69, 0.25});
  CHECK(low.by_head() == 1);
  low.laid({60, 69, 5}, {50, 69, 5});  // as high as the wall
  CHECK(low.by_head() == 1);
  Strikes high = wall(head, 10);
  high.laid({10, 120, 2.25}, {20, 120, 2.25});  // the rods are above 10 mm
  CHECK(high.by_head() == 0);
  high.laid({10, 110, 1.75}, {20, 110, 1.75});
  CHECK(high.by_head() == 1);
  CHECK(high.by_nozzle() == 0);
}
