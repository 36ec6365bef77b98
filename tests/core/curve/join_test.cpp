#include "core/curve/join.hpp"

#include <catch2/catch.hpp>

#include "core/curve/clearance.hpp"
#include "tests/core/support/shapes.hpp"

using namespace unicursal::core;
using namespace unicursal::core::test;

namespace {

/// A closed path along a circle.
Curve loop(const Vec2& center, double radius, bool counter_clockwise) {
  return {circle(center, radius, static_cast<int>(radius * 15), counter_clockwise)};
}

}  // namespace

TEST_CASE("loops side by side become one simple curve, in whichever direction they run") {
  const bool first = GENERATE(true, false), second = GENERATE(true, false);
  const Polygon island = rectangle(20, 10);
  const Curve a = loop({5, 5}, 4.5, first), b = loop({14.9, 5}, 4.5, second);
  const auto one = joined({a, b}, island, 1.0);
  REQUIRE(one);
  CHECK(self_intersections(*one) == 0);
  CHECK(segments_outside(*one, BorderIndex(island, 1.0)) == 0);
  // Two stretches of about a bead width are removed, and two bridges of one to two bead widths are added.
  CHECK(one->length() == Approx(a.length() + b.length()).margin(3.0));
}

TEST_CASE("a loop inside another is joined to it") {
  const bool inner_way = GENERATE(true, false);
  const auto one = joined({loop({10, 10}, 8, true), loop({10, 10}, 7, inner_way)}, rectangle(20, 20), 1.0);
  REQUIRE(one);
  CHECK(self_intersections(*one) == 0);
  // The joined curve encloses only the ring between the two loops, or almost the whole outer loop.
  CHECK(std::abs(signed_area(one->vertices)) == Approx(std::numbers::pi * (64 - 49)).epsilon(0.1));
}

TEST_CASE("a chain of loops is joined to one curve") {
  std::vector<Curve> chain;
  for (const int k : {3, 0, 2, 4, 1}) chain.push_back(loop({3.0 + 5.0 * k, 3}, 2, true));
  const auto one = joined(chain, rectangle(30, 6), 1.0);
  REQUIRE(one);
  CHECK(self_intersections(*one) == 0);
}

TEST_CASE("loops that are too far apart, or separated by a wall, are not joined") {
  CHECK_FALSE(joined({loop({5, 5}, 3, true), loop({15, 5}, 3, true)}, rectangle(20, 10), 1.0));
  Polygon walled = rectangle(20, 10);
  walled.holes.push_back({{9.9, 0.2}, {9.9, 9.8}, {10.1, 9.8}, {10.1, 0.2}});
  CHECK_FALSE(joined({loop({5, 5}, 4.5, true), loop({15, 5}, 4.5, true)}, walled, 1.0));
}
