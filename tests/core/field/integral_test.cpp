#include <catch2/catch.hpp>
#include <numbers>

#include "core/field/direction_field.hpp"
#include "core/field/grid_cover.hpp"
#include "tests/core/support/shapes.hpp"

using namespace unicursal::core;
using namespace unicursal::core::test;

namespace {

/// Random vectors in every square, so that mistakes in indexing show.
DirectionField random_field(Random& random, const Box& box, double pitch) {
  const Grid grid = grid_around(box, pitch);
  std::vector<Vec2> values(grid.size());
  for (Vec2& v : values) v = Vec2(random.uniform(-0.7, 0.7), random.uniform(-0.7, 0.7));
  return {grid, values, std::vector<double>(grid.size(), 1)};
}

DirectionField uniform_field(const Box& box, double pitch, double angle) {
  const Grid grid = grid_around(box, pitch);
  return {grid, std::vector<Vec2>(grid.size(), doubled(angle)), std::vector<double>(grid.size(), 1)};
}

/// Independent of edges: the sum over squares of the vector times the area shared with the polygon, by
/// Clipper.
Vec2 by_clipping(const DirectionField& field, const Polygon& polygon) {
  const Grid& grid = field.grid();
  Vec2 sum(0, 0);
  for (std::size_t column = 0; column < grid.columns; ++column) {
    for (std::size_t row = 0; row < grid.rows; ++row) {
      const Vec2 c = grid.center(column, row), x(grid.pitch / 2, 0), y(0, grid.pitch / 2);
      const Polygon square{{c - x - y, c + x - y, c + x + y, c - x + y}, {}};
      sum += area(intersect({square}, {polygon})) * field.at(c);
    }
  }
  return sum;
}

void check_equal(const Vec2& a, const Vec2& b, double tolerance) {
  CHECK(a.x() == Approx(b.x()).margin(tolerance));
  CHECK(a.y() == Approx(b.y()).margin(tolerance));
}

}  // namespace

TEST_CASE("the integral over random polygons with holes is the sum over their pieces in every square") {
  Random random(21);
  for (int k = 0; k < 20; ++k) {
    const Polygon island = random_island(random, 5, 3);
    const DirectionField field = random_field(random, bounds(island), random.uniform(0.3, 1.1));
    check_equal(field.integral(island), by_clipping(field, island), 1e-3);  // Clipper's grid is 1e-6 mm
  }
}

TEST_CASE("the integral over a random triangle agrees with a million samples") {
  Random random(22);
  const DirectionField field = random_field(random, {{0, 0}, {8, 8}}, 0.9);
  const Ring triangle{{0.3, 1.1}, {7.6, 2.3}, {3.1, 7.7}};
  Vec2 sum(0, 0);
  const int n = 1000;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const Vec2 p(8.0 * (i + 0.5) / n, 8.0 * (j + 0.5) / n);
      if (contains(triangle, p)) sum += 64.0 / (n * n) * field.at(p);
    }
  }
  check_equal(field.integral(triangle), sum, 0.01);
}

TEST_CASE("edges along grid lines: one square's integral is its vector times its area") {
  Random random(23);
  const DirectionField field = random_field(random, {{0, 0}, {4, 3}}, 0.5);
  const Grid& grid = field.grid();
  const auto corner = [&](double column, double row) {
    return Vec2(grid.origin + grid.pitch * Vec2(column, row));
  };
  for (std::size_t column = 0; column < grid.columns; ++column) {
    for (std::size_t row = 0; row < grid.rows; ++row) {
      const auto x = static_cast<double>(column), y = static_cast<double>(row);
      const Ring square{corner(x, y), corner(x + 1, y), corner(x + 1, y + 1), corner(x, y + 1)};
      check_equal(field.integral(square), 0.25 * field.at(grid.center(column, row)), 1e-12);
      const Ring lower_half{corner(x, y), corner(x + 1, y), corner(x + 1, y + 1)};
      check_equal(field.integral(lower_half), 0.125 * field.at(grid.center(column, row)), 1e-12);
    }
  }
}

TEST_CASE("vertical edges have no area under them, edges back and forth cancel") {
  Random random(24);
  const DirectionField field = random_field(random, {{0, 0}, {4, 3}}, 0.37);
  CHECK(field.integral_under({1.3, 0.2}, {1.3, 2.9}).norm() == 0);
  const Vec2 a(0.1, 2.2), b(3.7, 0.4);
  CHECK((field.integral_under(a, b) + field.integral_under(b, a)).norm() < 1e-12);
  CHECK(field.integral_under(a, b).norm() > 0.01);
}

TEST_CASE("outside the grid the field is zero") {
  Random random(25);
  const DirectionField field = random_field(random, {{0, 0}, {4, 3}}, 0.5);
  const Grid& grid = field.grid();
  const Vec2 top = grid.origin + grid.pitch * Vec2(double(grid.columns), double(grid.rows));
  const Ring all{grid.origin, {top.x(), grid.origin.y()}, top, {grid.origin.x(), top.y()}};
  const Ring more{{-50, -71}, {63, -55}, {58, 77}, {-49, 62}};
  check_equal(field.integral(more), field.integral(all), 1e-10);
  CHECK(field.integral(Ring{{20, 1}, {30, 1}, {25, 9}}).norm() < 1e-12);
  CHECK(field.integral(Ring{{1, 20}, {3, 20}, {2, 29}}).norm() < 1e-12);
  CHECK(field.integral(Ring{{1, -20}, {3, -20}, {2, -9}}).norm() < 1e-12);
  CHECK(field.at({-30, 1}).norm() == 0);
  CHECK(field.at({1, 1e300}).norm() == 0);
}

TEST_CASE("a uniform field integrates to the area times its vector") {
  const double angle = 0.4;
  const Polygon polygon = square_with_hole();
  const DirectionField field = uniform_field(bounds(polygon), 0.31, angle);
  check_equal(field.integral(polygon), area(polygon) * Vec2(std::cos(0.8), std::sin(0.8)), 1e-9);
  CHECK(direction(field.integral(polygon)) == Approx(angle));
  const Vec2 a(3, 2), b(4.1, 2.9);
  const double expected = 0.7 * (b - a).norm();
  check_equal(field.integral_around(a, b, 0.7), expected * doubled(angle), 1e-9);
  check_equal(field.quick_integral_around(a, b, 0.7), expected * doubled(angle), 1e-9);
}

TEST_CASE("the integral around an edge is that of its rectangle, and the quick one is close to it") {
  // A field that turns once in 12 mm, as around a small hole.
  const Grid grid = grid_around({{0, 0}, {12, 12}}, 0.25);
  std::vector<Vec2> values(grid.size());
  for (std::size_t c = 0; c < grid.columns; ++c) {
    for (std::size_t r = 0; r < grid.rows; ++r) {
      values[grid.index(c, r)] = doubled(2 * std::numbers::pi * grid.center(c, r).x() / 12);
    }
  }
  const DirectionField field(grid, values, std::vector<double>(grid.size(), 1));
  Random random(26);
  for (int k = 0; k < 100; ++k) {
    const Vec2 a(random.uniform(2, 10), random.uniform(2, 10));
    const double turn = random.uniform(0, 6.3), width = random.uniform(0.3, 1),
                 length = random.uniform(0.3, 1);
    const Vec2 along(std::cos(turn), std::sin(turn)), b = a + length * along;
    const Vec2 side = width / 2 * perpendicular(along);
    const Vec2 exact = field.integral(Ring{a - side, b - side, b + side, a + side});
    check_equal(field.integral_around(a, b, width), exact, 1e-10);
    check_equal(field.quick_integral_around(a, b, width), exact, 0.12 * width * length);
  }
}

TEST_CASE("opposite directions have the same doubled vector, a right angle negates it") {
  for (const double angle : {-1.2, 0.0, 0.3, 1.5}) {
    check_equal(doubled(angle), doubled(angle + std::numbers::pi), 1e-12);
    check_equal(doubled(angle), -doubled(angle + std::numbers::pi / 2), 1e-12);
    check_equal(doubled(Vec2(-3 * Vec2(std::cos(angle), std::sin(angle)))), doubled(angle), 1e-12);
    CHECK(direction(7 * doubled(angle)) == Approx(angle));
  }
  CHECK(doubled(Vec2(0, 0)).norm() == 0);
}

TEST_CASE("the covered shares of squares agree with clipping and add up to the area") {
  Random random(27);
  for (int k = 0; k < 10; ++k) {
    const Polygon island = random_island(random, 5, 3);
    const Grid grid = grid_around(bounds(island), random.uniform(0.4, 1.5));
    const std::vector<double> shares = cover(grid, {island});
    double sum = 0;
    for (std::size_t column = 0; column < grid.columns; ++column) {
      for (std::size_t row = 0; row < grid.rows; ++row) {
        const Vec2 c = grid.center(column, row), x(grid.pitch / 2, 0), y(0, grid.pitch / 2);
        const Polygon square{{c - x - y, c + x - y, c + x + y, c - x + y}, {}};
        const double share = shares[grid.index(column, row)] * grid.pitch * grid.pitch;
        CHECK(share == Approx(area(intersect({square}, {island}))).margin(1e-4));
        sum += share;
      }
    }
    CHECK(sum == Approx(area(island)).epsilon(1e-9));
  }
}

TEST_CASE("huge boxes and thin ones get a bounded number of squares") {
  CHECK(grid_around({{0, 0}, {1e5, 1e5}}, 0.01).size() < 5'000'000);
  CHECK(grid_around({{0, 0}, {1e5, 1e-9}}, 0.001).size() < 5'000'000);
  const Grid grid = grid_around({{-1, 2}, {3, 3}}, 0.25);
  CHECK(grid.pitch == 0.25);
  CHECK(grid.origin.x() <= -1.125);
  CHECK(grid.origin.y() + 0.25 * static_cast<double>(grid.rows) >= 3.125);
}
