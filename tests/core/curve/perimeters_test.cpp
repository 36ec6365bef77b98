#include "core/curve/perimeters.hpp"

#include <catch2/catch.hpp>

#include "core/curve/clearance.hpp"
#include "core/curve/track.hpp"
#include "tests/core/support/shapes.hpp"

using namespace unicursal::core;
using namespace unicursal::core::test;

namespace {

constexpr double w = 0.5, least = 0.55 * w;

std::vector<Curve> all_rings(const Perimeters& laid) {
  std::vector<Curve> all;
  for (const auto& rings : laid.rings) all.insert(all.end(), rings.begin(), rings.end());
  return all;
}

/// Checks that every ring is simple, inside, and apart from the others.
void check_rings(const Perimeters& laid, const Polygon& region) {
  const std::vector<Curve> all = all_rings(laid);
  for (std::size_t i = 0; i < all.size(); ++i) {
    REQUIRE(all[i].size() >= 5);
    REQUIRE(self_intersections(all[i]) == 0);
    REQUIRE(segments_outside(all[i], BorderIndex(region, w)) == 0);
    for (std::size_t j = 0; j < all.size(); ++j) {
      if (i == j) continue;
      const BorderIndex other({all[j].vertices, {}}, w);
      for (std::size_t k = 0; k < all[i].size(); ++k)
        REQUIRE(other.distance(all[i].vertices[k], all[i].vertices[all[i].after(k)], w) > 0);
    }
  }
}

/// The least and the greatest distance to the border along a curve.
std::pair<double, double> distances(const Curve& curve, const Polygon& region, const Box& where) {
  const Track track(curve);
  std::pair<double, double> range{1e9, 0};
  for (double s = 0; s < track.length(); s += 0.05) {
    const Vec2 p = track.at(s);
    if ((p.array() < where.min.array()).any() || (p.array() > where.max.array()).any()) continue;
    const double d = distance_to_border(region, p);
    range = {std::min(range.first, d), std::max(range.second, d)};
  }
  return range;
}

}  // namespace

TEST_CASE("contour k of a square with a hole runs k - 1/2 bead widths inside every border") {
  const Polygon square = square_with_hole();
  const Perimeters laid = perimeters(square, 3, w, least);
  check_rings(laid, square);
  REQUIRE(laid.rings.size() == 3);
  for (std::size_t k = 0; k < 3; ++k) {
    REQUIRE(laid.rings[k].size() == 2);
    for (const Curve& ring : laid.rings[k]) {
      const auto [low, high] = distances(ring, square, bounds(square));
      const double depth = (static_cast<double>(k) + 0.5) * w;
      CHECK(low == Approx(depth).epsilon(0.01));
      CHECK(high == Approx(depth).margin(0.06 * w));  // corners are rounded a little
    }
  }
  for (const Polygon& rest : laid.inside) {
    for (const Vec2& p : rest.outer) CHECK(distance_to_border(square, p) > 2.99 * w);
  }
}

TEST_CASE("a strip gets as many contours as fit, and the rest is at least 0.8 bead widths wide") {
  const auto count = [](double width) { return perimeters(rectangle(12, width * w), 9, w, least); };
  CHECK(count(0.5).rings.empty());
  CHECK(count(0.7).rings.size() == 1);
  CHECK(count(2.7).rings.size() == 1);
  CHECK(count(2.7).inside.empty());
  CHECK(count(3.0).rings.size() == 2);
  CHECK(count(6.0).rings.size() == 3);
  const Perimeters one = perimeters(rectangle(12, 3 * w), 1, w, least);
  REQUIRE(one.inside.size() == 1);
  CHECK(area(one.inside) == Approx((12 - 2 * w) * w).epsilon(0.05));
}

TEST_CASE("strands in a neck lie at a quarter of its width, so that two beads fill it") {
  const double neck = GENERATE(0.7, 1.0, 1.3, 1.7) * w;
  Region two = unite({rectangle(5, 5)}, {{{{4, 2}, {11, 2}, {11, 2 + neck}, {4, 2 + neck}}, {}}});
  two = unite(two, {{{{10, 0}, {15, 0}, {15, 5}, {10, 5}}, {}}});
  const Perimeters laid = perimeters(two.front(), 1, w, least);
  check_rings(laid, two.front());
  REQUIRE(laid.rings.front().size() == 1);  // one ring passes through the neck, there and back
  CHECK(laid.inside.size() == 2);
  const auto [low, high] = distances(laid.rings[0][0], two.front(), {{6, 0}, {9, 5}});
  CHECK(low == Approx(neck / 4).margin(0.06 * w));
  CHECK(high == Approx(neck / 4).margin(0.06 * w));
  const auto [square_low, square_high] = distances(laid.rings[0][0], two.front(), {{0, 0}, {3, 5}});
  CHECK(square_low == Approx(w / 2).epsilon(0.01));
  CHECK(square_high == Approx(w / 2).margin(0.06 * w));
}

TEST_CASE("a ring reaches into a spike until two beads no longer fit") {
  const Polygon wedge{{{0, 0}, {14, -1.5}, {14, 1.5}}, {}};
  const Perimeters laid = perimeters(wedge, 2, w, least);
  check_rings(laid, wedge);
  double reach = 14;
  for (const Vec2& p : laid.rings[0][0].vertices) reach = std::min(reach, p.x());
  CHECK(reach * 3 / 14 == Approx(least).epsilon(0.25));  // the wedge's width there
}

TEST_CASE("random islands: rings are simple, inside and apart, and keep clear of the area left to the fill") {
  Random random(5);
  for (int k = 0; k < 40; ++k) {
    const Polygon island = random_island(random, random.uniform(1, 6), 6);
    CAPTURE(k, area(island));
    const Perimeters laid = perimeters(island, 1 + k % 3, w, least);
    check_rings(laid, island);
    for (const Curve& ring : all_rings(laid)) {
      for (const Polygon& rest : laid.inside) {
        for (const Vec2& p : ring.vertices)
          REQUIRE((!contains(rest, p) && distance_to_border(rest, p) > 0.2 * w));
      }
    }
  }
}
