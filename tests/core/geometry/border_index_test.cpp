#include "core/geometry/border_index.hpp"

#include <catch2/catch.hpp>

#include "tests/core/support/shapes.hpp"

using namespace unicursal::core;
using namespace unicursal::core::test;

TEST_CASE("contains() agrees with the even-odd rule") {
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

TEST_CASE("winding numbers count overlaps, also of rings with the wrong orientation") {
  // Two squares that overlap, a hole in the first, and a tail whose sides have changed places.
  const Polygon odd{{{0, 0}, {6, 0}, {6, 2.6}, {9, 2.4}, {9, 2.6}, {6, 2.4}, {6, 6}, {0, 6}},
                    {{{4, 4}, {8, 4}, {8, 5.5}, {4, 5.5}}, {{1, 1}, {1, 2}, {2, 2}, {2, 1}}}};
  const double pitch = GENERATE(0.1, 0.5, 1.0, 20.0);
  const BorderIndex border(odd, pitch);
  CHECK(border.winding({3, 3}) == 1);
  CHECK(border.winding({5, 5}) == 2);
  CHECK(border.winding({7, 5}) == 1);
  CHECK(border.winding({1.5, 1.5}) == 0);
  CHECK(border.winding({8.9, 2.5}) == 1);
  CHECK(border.winding({6.1, 2.5}) == -1);
  CHECK(border.winding({7, 3}) == 0);
  // Summed over the plane they give the signed area.
  Random random(5);
  const int count = 200000;
  const double signed_sum = signed_area(odd.outer) + signed_area(odd.holes[0]) + signed_area(odd.holes[1]);
  double sum = 0;
  for (int k = 0; k < count; ++k) sum += border.winding({random.uniform(0, 9), random.uniform(0, 6)});
  CHECK(sum / count * 54 == Approx(signed_sum).epsilon(0.02));
}

TEST_CASE("points far away are outside") {
  const BorderIndex border(rectangle(2, 1), 0.3);
  CHECK_FALSE(border.contains({1e9, 0.5}));
  CHECK_FALSE(border.contains({-1e9, 0.5}));
  CHECK_FALSE(border.contains({1, 1e9}));
}

TEST_CASE("the distance to the border agrees with brute force, up to the limit") {
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
