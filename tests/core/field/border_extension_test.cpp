#include "core/field/border_extension.hpp"

#include <catch2/catch.hpp>
#include <numbers>

#include "core/field/direction_field.hpp"
#include "core/numeric/grid_distance.hpp"
#include "tests/core/support/shapes.hpp"

using namespace unicursal::core;
using namespace unicursal::core::test;

namespace {

constexpr double one_degree = std::numbers::pi / 180;

/// Unsigned difference of the directions of two doubled vectors, 0…π/2.
double difference(const Vec2& a, const Vec2& b) {
  return std::abs(std::atan2(cross(a, b), a.dot(b))) / 2;
}

/// Calls visit(centre, V) for squares whose centre lies inside.
template <typename Visit>
void each_inside(const Grid& grid, const Polygon& polygon, const std::vector<Vec2>& v, Visit visit) {
  for (std::size_t column = 0; column < grid.columns; ++column) {
    for (std::size_t row = 0; row < grid.rows; ++row) {
      const Vec2 p = grid.center(column, row);
      if (contains(polygon, p)) visit(p, v[grid.index(column, row)]);
    }
  }
}

}  // namespace

TEST_CASE("in a disc, directions run around the centre") {
  const Vec2 center(3.17, -1.43);
  const Polygon disc{circle(center, 12, 200), {}};
  const Grid grid = grid_around(bounds(disc), 0.25);
  each_inside(grid, disc, extended_tangents(grid, {disc}), [&](const Vec2& p, const Vec2& v) {
    if ((p - center).norm() < 1) return;  // the singular point and its few squares
    REQUIRE(v.norm() == Approx(1));
    REQUIRE(difference(v, doubled(perpendicular(p - center))) < 5 * one_degree);
  });
}

TEST_CASE("in a ring, directions run around the hole") {
  Polygon annulus{circle({0, 0}, 10, 160), {circle({0, 0}, 3, 60, false)}};
  const Grid grid = grid_around(bounds(annulus), 0.2);
  each_inside(grid, annulus, extended_tangents(grid, {annulus}), [&](const Vec2& p, const Vec2& v) {
    REQUIRE(difference(v, doubled(perpendicular(p))) < 5 * one_degree);
  });
}

TEST_CASE("in a slanted strip, directions follow the strip, except at its ends") {
  const double angle = 0.6;
  const Vec2 along(std::cos(angle), std::sin(angle)), across = perpendicular(along);
  const Polygon strip{{Vec2(0, 0), 40 * along, 40 * along + 3 * across, 3 * across}, {}};
  const Grid grid = grid_around(bounds(strip), 0.2);
  each_inside(grid, strip, extended_tangents(grid, {strip}), [&](const Vec2& p, const Vec2& v) {
    if (p.dot(along) < 4 || p.dot(along) > 36) return;
    REQUIRE(difference(v, doubled(angle)) < 1 * one_degree);
  });
}

TEST_CASE("in a square, every point follows the nearest side") {
  const Polygon square = rectangle(10, 10);
  const Grid grid = grid_around(bounds(square), 0.2);
  each_inside(grid, square, extended_tangents(grid, {square}), [&](const Vec2& p, const Vec2& v) {
    const double across = std::abs(p.x() - 5), up = std::abs(p.y() - 5);
    if (std::abs(across - up) < 0.5) return;  // the diagonals, where two sides are equally near
    REQUIRE(difference(v, doubled(across > up ? std::numbers::pi / 2 : 0.0)) < 1e-6);
  });
}

TEST_CASE("a border with teeth finer than the grid counts by its general direction") {
  Polygon comb;
  for (int k = 0; k <= 400; ++k) comb.outer.push_back({k * 0.05, k % 2 == 0 ? 0.0 : 0.02});
  comb.outer.push_back({20, 5});
  comb.outer.push_back({0, 5});
  const Grid grid = grid_around(bounds(comb), 0.25);
  each_inside(grid, comb, extended_tangents(grid, {comb}), [&](const Vec2& p, const Vec2& v) {
    // A square holds five flanks of 22°, three of one kind and two of the other.
    if (p.x() > 6 && p.x() < 14) REQUIRE(difference(v, doubled(0.0)) < (p.y() < 0.5 ? 6 : 2) * one_degree);
  });
}

namespace {

/// The problem of the header, written independently and solved by plain relaxation.
struct PlainRelaxation {
  const Grid& grid;
  const Polygon& polygon;
  std::vector<Vec2> v;
  std::vector<double> border, stiffness;
  std::vector<std::size_t> free;

  PlainRelaxation(const Grid& grid_, const Polygon& polygon_)
      : grid(grid_),
        polygon(polygon_),
        v(grid.size(), Vec2(0, 0)),
        border(grid.size()),
        stiffness(grid.size()) {
    mark(polygon.outer);
    for (const Ring& hole : polygon.holes) mark(hole);
    for (std::size_t k = 0; k < grid.size(); ++k) {
      if (border[k] > 0) v[k] /= border[k];
      if (border[k] == 0 && contains(polygon, center(k))) free.push_back(k);
      const double d = std::max(distance(k), 0.5);
      stiffness[k] = 1 / (d * d);
    }
  }

  Vec2 center(std::size_t k) const { return grid.center(k / grid.rows, k % grid.rows); }

  void mark(const Ring& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vec2 edge = ring[(i + 1) % ring.size()] - ring[i];
      for (int k = 0; k < 4000; ++k) {
        const Vec2 p = grid.in_squares(ring[i] + (k + 0.5) / 4000 * edge);
        const auto square = grid.index(static_cast<std::size_t>(p.x()), static_cast<std::size_t>(p.y()));
        v[square] += edge.norm() * doubled(edge);
        border[square] += edge.norm();
      }
    }
  }

  double distance(std::size_t k) const {
    double best = 1e9;
    for (std::size_t i = 0; i < grid.size(); ++i) {
      if (border[i] > 0) best = std::min(best, (center(i) - center(k)).norm() / grid.pitch);
    }
    return best;
  }

  void sweep() {
    for (const std::size_t k : free) {
      Vec2 sum(0, 0);
      double total = 0;
      for (const std::size_t n : {k - 1, k + 1, k - grid.rows, k + grid.rows}) {
        sum += (stiffness[k] + stiffness[n]) * v[n];
        total += stiffness[k] + stiffness[n];
      }
      v[k] = sum / total;
    }
  }
};

}  // namespace

TEST_CASE("multigrid agrees with plain relaxation") {
  Ring ellipse;
  for (const Vec2& p : circle({0, 0}, 1, 150)) ellipse.push_back({9 * p.x(), 5 * p.y()});
  const Polygon polygon{ellipse, {circle({3, 1}, 1.5, 40, false)}};
  const Grid grid = grid_around(bounds(polygon), 0.33);
  const std::vector<Vec2> found = extended_tangents(grid, {polygon});
  PlainRelaxation plain(grid, polygon);
  for (int k = 0; k < 3000; ++k) plain.sweep();
  for (const std::size_t k : plain.free) {
    if (plain.v[k].norm() > 0.02) REQUIRE(difference(found[k], plain.v[k]) < 0.5 * one_degree);
  }
}

TEST_CASE("the distance to marked squares agrees with brute force") {
  Random random(51);
  Grid grid;
  grid.columns = 23;
  grid.rows = 17;
  for (int k = 0; k < 30; ++k) {
    std::vector<std::uint8_t> marked(grid.size());
    for (std::size_t n = 1 + random.below(12); n > 0; --n) marked[random.below(grid.size())] = 1;
    const std::vector<double> found = distance_to_marked(grid.columns, grid.rows, marked);
    for (std::size_t i = 0; i < grid.size(); ++i) {
      double best = 1e9;
      for (std::size_t j = 0; j < grid.size(); ++j) {
        const double across = double(i / grid.rows) - double(j / grid.rows);
        const double up = double(i % grid.rows) - double(j % grid.rows);
        if (marked[j] != 0) best = std::min(best, std::hypot(across, up));
      }
      REQUIRE(found[i] == Approx(best));
    }
  }
  CHECK(std::isinf(
      distance_to_marked(grid.columns, grid.rows, std::vector<std::uint8_t>(grid.size(), 0)).front()));
}
