// Simplified paths, and the skirt.
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <numbers>
#include <random>

#include "firmware_gcode/route/simplify.hpp"
#include "firmware_gcode/toolpath/skirt.hpp"

using namespace unicursal;
using namespace unicursal::gcode;

namespace {

double distance_to_segment(const core::Vec2& p, const core::Vec2& a, const core::Vec2& b) {
  const core::Vec2 way = b - a;
  const double t = std::clamp((p - a).dot(way) / way.squaredNorm(), 0.0, 1.0);
  return (p - (a + t * way)).norm();
}

double distance_to(const core::Vec2& p, const core::BeadPath& path) {
  double least = 1e9;
  for (std::size_t i = 0; i < path.size(); ++i) {
    least = std::min(least, distance_to_segment(p, path.start(i), path.end(i)));
  }
  return least;
}

/// A rectangle's border in `pieces` per side.
core::BeadPath rectangle(double x, double y, double width, double height, int pieces) {
  core::BeadPath path;
  const core::Vec2 corners[] = {{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}};
  for (int side = 0; side < 4; ++side) {
    for (int k = 0; k < pieces; ++k) {
      const core::Vec2 way = corners[(side + 1) % 4] - corners[side];
      path.beads.push_back({core::Vec2(corners[side] + way * k / pieces), 0.0, 0});
    }
  }
  for (std::size_t i = 0; i < path.size(); ++i) path.beads[i].area = 0.5 * path.length(i);
  return path;
}

}  // namespace

TEST_CASE("straight pieces of equal width become one") {
  const core::BeadPath path = simplified(rectangle(10, 10, 30, 20, 10));
  REQUIRE(path.size() == 4);
  CHECK(path.beads[1].position == core::Vec2(40, 10));
  CHECK(path.beads[0].area == Approx(15));
}

TEST_CASE("a vertex stays where width or zone changes") {
  core::BeadPath path = rectangle(10, 10, 30, 20, 10);
  path.beads[4].area *= 1.03;
  CHECK(simplified(path).size() == 6);  // before and after it
  path = rectangle(10, 10, 30, 20, 10);
  for (std::size_t i = 15; i < 25; ++i) path.beads[i].zone = 1;
  CHECK(simplified(path).size() == 6);
}

TEST_CASE("a path that turns back or stands still keeps its turn") {
  core::BeadPath path;
  for (const double x : {10.0, 12.0, 14.0, 12.0, 12.0}) path.beads.push_back({core::Vec2(x, 10), 1.0, 0});
  const core::BeadPath fewer = simplified(path);
  CHECK(fewer.size() == 4);  // only the first 12 is redundant
  CHECK(fewer.beads[1].position == core::Vec2(14, 10));
}

TEST_CASE("no vertex moves away, no volume is lost, no bead changes its zone") {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> noise(-0.006, 0.006), widths(0.497, 0.503);
  for (int round = 0; round < 50; ++round) {
    core::BeadPath path = rectangle(10, 10, 30, 20, 40);
    for (std::size_t i = 0; i < path.size(); ++i) {
      path.beads[i].position += core::Vec2(noise(random), noise(random));
      path.beads[i].zone = i / 30;
    }
    for (std::size_t i = 0; i < path.size(); ++i) path.beads[i].area = widths(random) * path.length(i);
    const core::BeadPath fewer = simplified(path);
    CHECK(fewer.size() < path.size());
    for (const core::Bead& bead : path.beads) CHECK(distance_to(bead.position, fewer) <= 0.0100001);
    std::map<std::size_t, double> areas;
    for (const core::Bead& bead : path.beads) areas[bead.zone] += bead.area;
    for (const core::Bead& bead : fewer.beads) areas[bead.zone] -= bead.area;
    for (const auto& [zone, left] : areas) CHECK(std::abs(left) < 1e-9);
  }
}

TEST_CASE("a skirt keeps its distance from the part, from itself and from the bed's edge") {
  const Printer printer;  // 200 x 200 mm
  const PlacedLayer layer{0, 0.2, 0.2, {rectangle(60, 70, 40, 20, 7), rectangle(120, 60, 10, 50, 3)}};
  const auto rings = skirt(layer, {3, 4}, printer);
  REQUIRE(rings.size() == 3);
  for (std::size_t ring = 0; ring < rings.size(); ++ring) {
    const double away =
        4 + 0.5 * (3 - static_cast<double>(ring));  // middle of the bead, from the beads' middle
    double nearest = 1e9;
    for (const core::Bead& bead : rings[ring].beads) {
      const double d =
          std::min(distance_to(bead.position, layer.paths[0]), distance_to(bead.position, layer.paths[1]));
      nearest = std::min(nearest, d);
      CHECK(d >= away - 1e-9);
    }
    CHECK(nearest == Approx(away));
    CHECK(rings[ring].total_area() == Approx(0.5 * rings[ring].total_length()));
  }
}

TEST_CASE("a skirt moves nearer to the part at the bed's edge, and is omitted without room") {
  Printer printer;
  printer.bed = {60, 60, 60};
  const auto tight = skirt({0, 0.2, 0.2, {rectangle(5, 5, 50, 50, 5)}}, {2, 10}, printer);
  REQUIRE(tight.size() == 2);
  for (const core::BeadPath& ring : tight) {
    for (const core::Bead& bead : ring.beads) {
      CHECK(bead.position.minCoeff() >= 1.25 - 1e-9);
      CHECK(bead.position.maxCoeff() <= 58.75 + 1e-9);
    }
  }
  CHECK(skirt({0, 0.2, 0.2, {rectangle(2, 2, 56, 56, 5)}}, {2, 10}, printer).empty());
  CHECK(skirt({0, 0.2, 0.2, {}}, {2, 10}, printer).empty());
  CHECK(skirt({0, 0.2, 0.2, {rectangle(5, 5, 50, 50, 5)}}, {0, 10}, printer).empty());
}
