#include "core/geometry/region.hpp"

#include <catch2/catch.hpp>

#include "tests/core/support/shapes.hpp"

using namespace unicursal::core;
using namespace unicursal::core::test;

TEST_CASE("areas of union, intersection and difference obey inclusion and exclusion") {
  Random random(2);
  for (int k = 0; k < 50; ++k) {
    const Region a{random_island(random, 5, 3)}, b{random_island(random, 5, 3)};
    REQUIRE(area(unite(a, b)) + area(intersect(a, b)) == Approx(area(a) + area(b)).epsilon(1e-6));
    REQUIRE(area(subtract(a, b)) == Approx(area(a) - area(intersect(a, b))).margin(1e-4));
  }
}

TEST_CASE("uniting many regions at once equals uniting one after another") {
  Random random(6);
  std::vector<Region> regions;
  std::vector<const Region*> pointers;
  Region sum;
  for (int k = 0; k < 30; ++k) {
    Polygon piece = random_island(random, 4, 3);
    const Vec2 shift(random.uniform(0, 20), random.uniform(0, 20));
    for (Vec2& v : piece.outer) v += shift;
    for (Ring& hole : piece.holes) {
      for (Vec2& v : hole) v += shift;
    }
    regions.push_back({piece});
  }
  for (const Region& region : regions) {
    pointers.push_back(&region);
    sum = unite(sum, region);
  }
  const Region at_once = unite(pointers);
  CHECK(area(at_once) == Approx(area(sum)).epsilon(1e-5));
  CHECK(area(subtract(at_once, sum)) < 1e-3);
}

TEST_CASE("outer rings run counter-clockwise, holes clockwise, islands within holes stand alone") {
  const Region region = enclosed({circle({0, 0}, 5, 50), circle({0, 0}, 3, 50, false), circle({0, 0}, 1, 50)},
                                 FillRule::even_odd);
  REQUIRE(region.size() == 2);
  for (const Polygon& polygon : region) {
    CHECK(signed_area(polygon.outer) > 0);
    for (const Ring& hole : polygon.holes) CHECK(signed_area(hole) < 0);
  }
}

TEST_CASE("an offset grows a square by its perimeter and a rounded corner") {
  const double grown = area(offset({rectangle(10, 10)}, 2, 0.001));
  CHECK(grown == Approx(100 + 4 * 10 * 2 + std::numbers::pi * 4).epsilon(1e-4));
  CHECK(area(offset({rectangle(10, 10)}, -2, 0.001)) == Approx(36).epsilon(1e-6));
  CHECK(offset({rectangle(3, 10)}, -2, 0.001).empty());
}

TEST_CASE("opening removes exactly what a disc cannot reach") {
  // A square with a fin 0.2 mm thick.
  const Region fin = unite({rectangle(10, 10)}, {{{{10, 5}, {15, 5}, {15, 5.2}, {10, 5.2}}, {}}});
  const Region open = opened(fin, 0.5, 0.001);
  CHECK(area(open) == Approx(100 - (4 - std::numbers::pi) * 0.25).epsilon(1e-3));
  CHECK(area(subtract(open, fin)) < 1e-4);
}

TEST_CASE("simplified rings stay within the tolerance") {
  const Ring fine = circle({0, 0}, 10, 2000);
  const Ring coarse = simplified(fine, 0.01);
  CHECK(coarse.size() < 150);
  for (const Vec2& p : fine) {
    double d = 1e9;
    for (std::size_t i = 0; i < coarse.size(); ++i) {
      d = std::min(d, distance_to_segment(p, coarse[i], coarse[(i + 1) % coarse.size()]));
    }
    REQUIRE(d <= 0.01 + 1e-12);
  }
}

TEST_CASE("an offset of thousands of vertices keeps its distance, smooth outline or rough") {
  // In one step Clipper takes minutes over the rough ones.
  const double noise = GENERATE(0.0, 1e-3, 0.1, 0.3), distance = GENERATE(-1.0, 0.5);
  const double tolerance = 0.01;
  Random random(4);
  Ring outer;
  const int sides = 3000;
  for (int k = 0; k < sides; ++k) {
    const double turn = 2 * std::numbers::pi * k / sides;
    outer.push_back((3 + noise * random.uniform(-1, 1)) * Vec2(std::cos(turn), std::sin(turn)));
  }
  const Region shifted = offset({{outer, {}}}, distance, tolerance);
  REQUIRE(shifted.size() == 1);
  REQUIRE(shifted.front().holes.empty());
  for (const Vec2& p : shifted.front().outer) {
    double nearest = 10;
    for (std::size_t i = 0; i < outer.size(); ++i)
      nearest = std::min(nearest, distance_to_segment(p, outer[i], outer[(i + 1) % outer.size()]));
    REQUIRE(nearest == Approx(std::abs(distance)).margin(3 * tolerance));
  }
  if (noise == 0) {
    const double radius = 3 + distance;
    CHECK(area(shifted) == Approx(std::numbers::pi * radius * radius).epsilon(0.01));
  }
}
