#include "core/geometry/border_index.hpp"

#include <catch2/catch.hpp>

#include "tests/core/support/shapes.hpp"

using namespace unicursal::core;
using namespace unicursal::core::test;

TEST_CASE("inside by the grid is inside by the even-odd rule") {
  Random random(7);
  const Polygon polygon = GENERATE(rectangle(10, 10), square_with_hole());
  // Pitches that put grid lines through vertices of the shapes, too.
  const double pitch = GENERATE(0.1, 0.5, 1.0, 3.0, 12.0);
  const BorderIndex border(polygon, pitch);
  for (int k = 0; k < 20000; ++k) {
    const Vec2 p(random.uniform(-1, 13), random.uniform(-1, 13));
    REQUIRE(border.contains(p) == contains(polygon, p));
  }
}

TEST_CASE("points far away are outside") {
  const BorderIndex border(rectangle(2, 1), 0.3);
  CHECK_FALSE(border.contains({1e9, 0.5}));
  CHECK_FALSE(border.contains({-1e9, 0.5}));
  CHECK_FALSE(border.contains({1, 1e9}));
}

TEST_CASE("distance to the border is that of brute force up to the limit") {
  Random random(3);
  const Polygon polygon = square_with_hole();
  const BorderIndex border(polygon, 0.7);
  for (int k = 0; k < 300; ++k) {
    const Vec2 a(random.uniform(0, 12), random.uniform(0, 12));
    const Vec2 b = a + Vec2(random.uniform(-1, 1), random.uniform(-1, 1));
    double exact = 2.0;
    for (const BorderEdge& edge : border.edges())
      exact = std::min(exact, distance_between_segments(a, b, edge.a, edge.b));
    REQUIRE(border.distance(a, b, 2.0) == Approx(exact).margin(1e-12));
  }
}

TEST_CASE("distance between segments: crossing, parallel, end to end, point") {
  CHECK(distance_between_segments({0, 0}, {2, 2}, {0, 2}, {2, 0}) == 0);
  CHECK(distance_between_segments({0, 0}, {2, 0}, {0, 1}, {2, 1}) == Approx(1));
  CHECK(distance_between_segments({0, 0}, {1, 0}, {4, 4}, {9, 4}) == Approx(5));
  CHECK(distance_between_segments({0, 0}, {0, 0}, {3, 4}, {3, 4}) == Approx(5));
}
