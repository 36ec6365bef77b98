#include "firmware_gcode/route/detour.hpp"

#include <catch2/catch.hpp>

using namespace unicursal;
using namespace unicursal::gcode;

namespace {

core::Polygon square(double x, double y, double side) {
  return {{{x, y}, {x + side, y}, {x + side, y + side}, {x, y + side}}, {}};
}

const core::Box bed{{0, 0}, {200, 200}};

double length(core::Vec2 here, const std::vector<core::Vec2>& via, const core::Vec2& to) {
  double sum = 0;
  for (const core::Vec2& p : via) sum += (p - here).norm(), here = p;
  return sum + (to - here).norm();
}

double nearest(core::Vec2 here, std::vector<core::Vec2> via, const core::Vec2& to,
               const core::Polygon& island) {
  double least = 1e9;
  via.push_back(to);
  for (const core::Vec2& p : via) {
    for (int i = 0; i <= 200; ++i) {
      const core::Vec2 at = here + (p - here) * (i / 200.0);
      least = std::min(least, core::contains(island, at) ? 0 : core::distance_to_border(island, at));
    }
    here = p;
  }
  return least;
}

}  // namespace

TEST_CASE("a travel goes around an island, hardly longer than a taut string") {
  const core::Polygon island = square(90, 95, 20);
  const core::Vec2 from(60, 100), to(140, 104);
  const auto via = detour(from, to, {square(50, 90, 12), island, square(135, 95, 12)}, bed);
  REQUIRE(via.size() >= 2);
  CHECK(nearest(from, via, to, island) > 0.9);
  const double taut = length(from, {{90, 95}, {110, 95}}, to);
  CHECK(length(from, via, to) < taut + 2);
}

TEST_CASE("a travel stays straight if it is free, or if a detour would be long") {
  const core::Vec2 from(60, 100), to(140, 100);
  CHECK(detour(from, to, {square(90, 110, 20)}, bed).empty());
  CHECK(detour(from, to, {}, bed).empty());
  CHECK(
      detour(from, to, {square(80, 30, 40), {{{95, 2}, {105, 2}, {105, 198}, {95, 198}}, {}}}, bed).empty());
}

TEST_CASE("a travel goes around holes, except one that contains its end") {
  core::Polygon plate = square(20, 20, 100);
  const core::Polygon hole = square(60, 60, 20);
  plate.holes = {{hole.outer.rbegin(), hole.outer.rend()}};
  const core::Vec2 from(40, 70), to(100, 71);
  const auto via = detour(from, to, {plate}, bed);
  REQUIRE(via.size() >= 2);
  CHECK(nearest(from, via, to, hole) > 0.9);
  CHECK(detour(from, {70, 70}, {plate, square(68, 68, 4)}, bed).empty());
}

TEST_CASE("no detour leaves the bed") {
  const core::Vec2 from(10, 3), to(60, 3);
  for (const core::Vec2& p : detour(from, to, {square(30, 0.5, 10)}, bed)) {
    CHECK(p.y() >= 0);
    CHECK(p.y() > 10);
  }
}
