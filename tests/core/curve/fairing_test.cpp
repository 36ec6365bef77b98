#include "core/curve/fairing.hpp"

#include <algorithm>
#include <catch2/catch.hpp>

#include "core/curve/clearance.hpp"
#include "core/curve/contour.hpp"
#include "core/curve/resample.hpp"
#include "core/cycle/first_cycle.hpp"
#include "tests/core/support/shapes.hpp"

using namespace unicursal::core;
using namespace unicursal::core::test;

namespace {

Curve first_curve(const Polygon& island, double d, std::uint64_t seed) {
  Random random(seed);
  const Region domain = offset(offset({island}, -0.2, 0.01), 0.15, 0.01);
  const auto graph = make_cell_graph(domain.front(), d, random);
  REQUIRE(graph);
  const auto cycle = first_cycle(*graph);
  REQUIRE(cycle);
  return drawn(cycle->tour);
}

void check_sound(const Curve& curve, const Polygon& island) {
  REQUIRE(self_intersections(curve) == 0);
  REQUIRE(segments_outside(curve, BorderIndex(island, 1.0)) == 0);
}

}  // namespace

TEST_CASE("segments that meet are counted, except neighbours") {
  CHECK(self_intersections({{{0, 0}, {4, 0}, {4, 4}, {0, 4}}}) == 0);
  CHECK(self_intersections({{{0, 0}, {4, 4}, {4, 0}, {0, 4}}}) == 1);
  CHECK(self_intersections({{{0, 0}, {4, 0}, {4, 4}, {2, 0}, {0, 4}}}) ==
        2);  // one vertex touches, and both of its segments count
}

TEST_CASE("segments outside the border are counted") {
  const BorderIndex border(square_with_hole(), 1);
  CHECK(segments_outside({{{1, 1}, {11, 1}, {11, 11}, {1, 11}}}, border) == 0);
  CHECK(segments_outside({{{1, 1}, {11, 1}, {11, 11}, {6, 6}, {1, 11}}}, border) == 2);
  CHECK(segments_outside({{{1, 1}, {13, 1}, {11, 11}, {1, 11}}}, border) == 2);
}

TEST_CASE("a vertex's freedom is 0.45 of the nearest distance, which brute force confirms") {
  const Polygon island = square_with_hole();
  const Curve curve = first_curve(island, 0.9, 5);
  const BorderIndex border(island, 1.0);
  const double reach = GENERATE(0.3, 2.0);
  const auto clearance = [&](std::size_t i) {
    const Vec2 &a = curve.vertices[i], &b = curve.vertices[curve.after(i)];
    double clear = border.distance(a, b, reach);
    for (std::size_t j = 0; j < curve.size(); ++j) {
      if (j == i || curve.after(i) == j || curve.after(j) == i) continue;
      clear =
          std::min(clear, distance_between_segments(a, b, curve.vertices[j], curve.vertices[curve.after(j)]));
    }
    return clear;
  };
  Workers two(2);
  const std::vector<double> free = freedom(curve, border, reach),
                            shared = freedom(curve, border, reach, {}, &two);
  CHECK(free == shared);
  for (std::size_t i = 0; i < curve.size(); ++i) {
    const double expected = 0.45 * std::min(clearance(i), clearance(curve.before(i)));
    REQUIRE(free[i] == Approx(expected).margin(1e-12));
  }
}

TEST_CASE("a faired curve is the same for any number of threads") {
  const Polygon island = square_with_hole();
  FairingOptions options;
  options.bead_width = 0.55;
  options.target_length = area(island) / options.bead_width;
  const Curve start = first_curve(island, 0.9, 5);
  const Curve one = fair(start, island, options).curve;
  Workers workers(3);
  options.workers = &workers;
  const Curve three = fair(start, island, options).curve;
  REQUIRE(one.size() == three.size());
  for (std::size_t i = 0; i < one.size(); ++i) REQUIRE(one.vertices[i] == three.vertices[i]);
}

TEST_CASE("vertices that stay within their freedom cannot make a curve cross itself or the border") {
  const Polygon island = square_with_hole();
  Curve curve = first_curve(island, 0.9, 5);
  Random random(8);
  for (int round = 0; round < 200; ++round) {
    const std::vector<double> free = freedom(curve, BorderIndex(island, 1.0), 0.6, {1e-3, 1e-3});
    for (std::size_t i = 0; i < curve.size(); ++i) {
      const double turn = random.uniform(0, 2 * std::numbers::pi);
      curve.vertices[i] += free[i] * Vec2(std::cos(turn), std::sin(turn));
    }
    check_sound(curve, island);
  }
}

TEST_CASE("respacing removes and adds vertices, and the curve stays simple and inside") {
  const Polygon island = square_with_hole();
  const BorderIndex border(island, 1.0);
  const Curve curve = first_curve(island, 0.9, 6);
  const Curve spread = respaced(curve, border, 0.45);
  check_sound(spread, island);
  for (std::size_t i = 0; i < spread.size(); ++i) {
    REQUIRE((spread.vertices[spread.after(i)] - spread.vertices[i]).norm() <= 1.5 * 0.45 + 1e-9);
  }
  const Curve fine = subdivided(spread);
  CHECK(fine.size() == 2 * spread.size());
  CHECK(fine.length() == Approx(spread.length()));
}

TEST_CASE("collapsed vertices are removed unless something lies in the corner that they cut off") {
  // A square of 4 mm whose lower side has a step of a hundredth of the spacing, and so almost no clearance.
  const Polygon island = rectangle(10, 10);
  const BorderIndex border(island, 1.0);
  Curve curve{{{3, 3}, {5, 3}, {5.001, 3.006}, {7, 3.006}, {7, 7}, {3, 7}}};
  for (double x = 6; x > 3.5; x -= 0.5) curve.vertices.push_back({3, x});
  const Curve thin = thinned(curve, border, 2.5);
  check_sound(thin, island);
  for (std::size_t i = 0; i < thin.size(); ++i)
    CHECK((thin.vertices[thin.after(i)] - thin.vertices[i]).norm() > 0.1);
  // A thorn of the island's border lies in the corner that would be cut off.
  Polygon thorned = island;
  thorned.holes = {{{5.0004, 3.004}, {5.0004, 3.00401}, {5.00041, 3.004}}};
  Curve around{
      {{3, 3}, {5, 3}, {5.001, 3.006}, {4, 6}, {3.5, 6}, {3.4, 5}, {3.3, 4.5}, {3.2, 4}, {3.1, 3.5}}};
  REQUIRE(segments_outside(around, BorderIndex(thorned, 1.0)) == 0);
  const Curve kept = thinned(around, BorderIndex(thorned, 1.0), 2.5);
  check_sound(kept, thorned);
  for (const Vec2& corner : {Vec2(5, 3), Vec2(5.001, 3.006)})
    CHECK(std::count(kept.vertices.begin(), kept.vertices.end(), corner) == 1);
}

TEST_CASE("a faired curve has the asked length, is inside and simple, and covers its island well") {
  const Polygon island = GENERATE(rectangle(14, 14), square_with_hole());
  const double w = 0.6;
  FairingOptions options;
  options.bead_width = w;
  options.target_length = area(island) / w;
  const Curve start = smoothed(first_curve(island, 1.5 * w, 2), island, w);
  check_sound(start, island);
  const Curve curve = fair(start, island, options).curve;
  check_sound(curve, island);
  CHECK(curve.length() == Approx(options.target_length).epsilon(0.01));
}

TEST_CASE("fairing the same curve twice gives the same bytes") {
  const Polygon island = square_with_hole();
  FairingOptions options;
  options.bead_width = 0.7;
  options.target_length = area(island) / 0.7;
  const Curve start = first_curve(island, 1.05, 3);
  CHECK(fair(start, island, options).curve.vertices == fair(start, island, options).curve.vertices);
}

TEST_CASE("contours of small islands are simple, inside, and half a bead from the border") {
  const Polygon island =
      GENERATE(rectangle(1.5, 1.5), rectangle(5, 0.3), Polygon{circle({0, 0}, 0.4, 30), {}},
               Polygon{{{0, 0}, {3, 0}, {0, 0.6}}, {}});
  const auto curve = contour(island, 0.5);
  REQUIRE(curve);
  check_sound(*curve, island);
  CHECK(curve->size() >= 5);
  CHECK_FALSE(contour(rectangle(5, 0.01), 0.5));
}
