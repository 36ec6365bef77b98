#include "core/field/make_direction_field.hpp"

#include <catch2/catch.hpp>
#include <numbers>

#include "tests/core/support/shapes.hpp"

using namespace unicursal::core;
using namespace unicursal::core::test;

namespace {

constexpr double pi = std::numbers::pi;

Zone zone(PatternKind kind, double angle = 0, bool along_zone_border = false) {
  Zone result;
  result.pattern.kind = kind;
  result.pattern.angle = angle;
  result.pattern.along_zone_border = along_zone_border;
  return result;
}

DirectionField field_of(const Island& island, const std::vector<Zone>& zones, double pitch = 0.25) {
  return make_direction_field(island, zones, pitch);
}

/// A 20 × 10 mm plate in two zones that meet at x = 8.3.
Island halves() {
  const Polygon outline = rectangle(20, 10);
  const Polygon left = rectangle(8.3, 10), right{{{8.3, 0}, {20, 0}, {20, 10}, {8.3, 10}}, {}};
  return {outline, {{0, {left}}, {1, {right}}}};
}

void check_equal(const Vec2& a, const Vec2& b, double tolerance) {
  CHECK(a.x() == Approx(b.x()).margin(tolerance));
  CHECK(a.y() == Approx(b.y()).margin(tolerance));
}

}  // namespace

TEST_CASE("patterns that ask for no direction give an empty field") {
  for (const PatternKind kind : {PatternKind::none, PatternKind::isotropic, PatternKind::anisotropic}) {
    const DirectionField field = field_of(whole(rectangle(5, 5)), {zone(kind)});
    CHECK(field.empty());
    CHECK(field.aligned_area() == 0);
    CHECK(field.integral(rectangle(5, 5)).norm() == 0);
    CHECK(field.at({2, 2}).norm() == 0);
    CHECK(field.quick_integral_around({1, 1}, {2, 2}, 1).norm() == 0);
  }
}

TEST_CASE("an angle fills its zone exactly, up to the border of the island") {
  const double angle = 0.7, pitch = GENERATE(0.25, 0.83);
  const Polygon polygon = square_with_hole();
  const DirectionField field = field_of(whole(polygon), {zone(PatternKind::angle, angle)}, pitch);
  CHECK(field.aligned_area() == Approx(area(polygon)).epsilon(1e-9));
  check_equal(field.integral(polygon), area(polygon) * doubled(angle), 1e-9);
  check_equal(field.at({0.01, 11.99}), doubled(angle), 1e-12);
}

TEST_CASE("a zone's integral is its area times its vector, wherever its border cuts the squares") {
  const Island island = halves();
  const DirectionField field =
      field_of(island, {zone(PatternKind::angle, 0.3), zone(PatternKind::isotropic)}, 0.37);
  CHECK(field.aligned_area() == Approx(83).epsilon(1e-9));
  check_equal(field.integral(island.outline), 83 * doubled(0.3), 1e-9);
  check_equal(field.at({4, 5}), doubled(0.3), 1e-12);
  CHECK(field.at({15, 5}).norm() == 0);

  const DirectionField both =
      field_of(island, {zone(PatternKind::angle, 0.3), zone(PatternKind::angle, 1.5)});
  check_equal(both.integral(island.outline), 83 * doubled(0.3) + 117 * doubled(1.5), 1e-9);
}

TEST_CASE("parallel is tangential in a disc, orthogonal radial") {
  const Polygon disc{circle({0, 0}, 10, 180), {}};
  const DirectionField parallel = field_of(whole(disc), {zone(PatternKind::parallel)});
  const DirectionField orthogonal = field_of(whole(disc), {zone(PatternKind::orthogonal)});
  for (const Vec2& p : circle({0, 0}, 6, 37)) {
    const double around = direction(doubled(perpendicular(p)));
    CHECK(std::abs(std::sin(direction(parallel.at(p)) - around)) < 0.05);
    CHECK(std::abs(std::cos(direction(orthogonal.at(p)) - around)) < 0.05);
  }
  CHECK(parallel.aligned_area() == Approx(area(disc)).epsilon(0.01));
}

TEST_CASE("the border between two zones counts only if the zone asks for it") {
  const Island island = halves();
  const DirectionField without =
      field_of(island, {zone(PatternKind::parallel), zone(PatternKind::isotropic)});
  const DirectionField with =
      field_of(island, {zone(PatternKind::parallel, 0, true), zone(PatternKind::isotropic)});
  const Vec2 near_border(7.9, 5);  // the island's long sides, 5 mm away, run along x
  CHECK(std::abs(direction(without.at(near_border))) < 0.1);
  CHECK(std::abs(direction(with.at(near_border))) == Approx(pi / 2).margin(0.1));
  CHECK(with.aligned_area() == Approx(83).epsilon(0.02));
  CHECK(with.at({15, 5}).norm() == 0);
}

TEST_CASE("equal arguments give equal bits") {
  Random random(31);
  for (int k = 0; k < 5; ++k) {
    const Island island = whole(random_island(random, 10, 4));
    const DirectionField one = field_of(island, {zone(PatternKind::parallel)});
    const DirectionField other = field_of(island, {zone(PatternKind::parallel)});
    for (std::size_t c = 0; c < one.grid().columns; ++c) {
      for (std::size_t r = 0; r < one.grid().rows; ++r) {
        const Vec2 p = one.grid().center(c, r);
        REQUIRE(one.at(p) == other.at(p));
        REQUIRE(one.at(p).norm() < 1 + 1e-12);  // finite, too
      }
    }
  }
}

TEST_CASE("islands smaller than a square, and thin ones, have a field too") {
  const DirectionField speck = field_of(whole(rectangle(0.01, 0.01)), {zone(PatternKind::angle, 0.2)}, 1);
  CHECK(speck.aligned_area() == Approx(1e-4));
  const DirectionField needle = field_of(whole(rectangle(30, 0.02)), {zone(PatternKind::parallel)}, 0.5);
  CHECK(needle.aligned_area() == Approx(0.6).epsilon(0.05));
  CHECK(std::abs(direction(needle.at({15, 0.01}))) < 1e-6);
}
