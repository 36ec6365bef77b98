#include "core/model/zoning.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <random>

#include "model_support.hpp"

using namespace unicursal::core;

namespace {

Region box(double x0, double y0, double x1, double y1) {
  return enclosed({{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}}, FillRule::non_zero);
}

Layer layer_of(const Zoning& zoning) {
  Layer layer;
  layer.islands = zoning.islands;
  return layer;
}

bool on_a_border(const Island& island, const Vec2& point) {
  constexpr double near = 1e-4;
  double distance = distance_to_border(island.outline, point);
  for (const ZoneRegion& zone : island.zones) {
    for (const Polygon& p : zone.polygons) distance = std::min(distance, distance_to_border(p, point));
  }
  return distance < near;
}

/// Zones add up to the outline; points inside it lie in one zone, points outside in none.
void check_partition(const Island& island) {
  double sum = 0;
  for (const ZoneRegion& zone : island.zones) {
    CHECK(area(zone.polygons) > 0);
    sum += area(zone.polygons);
  }
  CHECK(sum == Approx(area(island.outline)).epsilon(1e-6));
  std::mt19937 random(1);
  const Box box = bounds(island.outline);
  std::uniform_real_distribution<double> x(box.min.x() - 1, box.max.x() + 1),
      y(box.min.y() - 1, box.max.y() + 1);
  for (int i = 0; i < 300; ++i) {
    const Vec2 point(x(random), y(random));
    std::ptrdiff_t holders = 0;
    for (const ZoneRegion& zone : island.zones) {
      holders += std::count_if(zone.polygons.begin(), zone.polygons.end(),
                               [&](const Polygon& p) { return contains(p, point); });
    }
    if (holders != (contains(island.outline, point) ? 1 : 0)) CHECK(on_a_border(island, point));
  }
}

}  // namespace

TEST_CASE("later shapes cover earlier ones") {
  const Zoning zoning = zoned({{box(0, 0, 20, 20), 0, "a"}, {box(10, 10, 30, 30), 1, "b"}});
  REQUIRE(zoning.islands.size() == 1);
  check_partition(zoning.islands[0]);
  CHECK(zone_area(layer_of(zoning), 0) == Approx(300));
  CHECK(zone_area(layer_of(zoning), 1) == Approx(400));
}

TEST_CASE("a zone inside another makes a hole in it, not in the island") {
  const Zoning zoning = zoned({{box(0, 0, 20, 20), 0, "a"}, {box(5, 5, 10, 10), 1, "b"}});
  REQUIRE(zoning.islands.size() == 1);
  check_partition(zoning.islands[0]);
  CHECK(zoning.islands[0].outline.holes.empty());
  CHECK(zone_area(layer_of(zoning), 0) == Approx(375));
}

TEST_CASE("islands come largest first, each with its own zones only") {
  const Zoning zoning =
      zoned({{box(0, 0, 1, 1), 0, ""}, {box(5, 0, 9, 4), 1, ""}, {box(20, 0, 22, 2), 0, ""}});
  REQUIRE(zoning.islands.size() == 3);
  CHECK(area(zoning.islands[0].outline) == Approx(16));
  CHECK(zoning.islands[0].zones.at(0).zone == 1);
  CHECK(area(zoning.islands[2].outline) == Approx(1));
}

TEST_CASE("gaps up to the weld are closed, wider ones divide the part") {
  const double gap = GENERATE(0.0, 1e-6, 1e-4, 0.005, 0.0095);
  CAPTURE(gap);
  const Zoning zoning = zoned({{box(0, 0, 10, 20), 0, ""}, {box(10 + gap, 0, 20, 20), 1, ""}});
  REQUIRE(zoning.islands.size() == 1);
  check_partition(zoning.islands[0]);
  CHECK(area(zoning.islands[0].outline) == Approx(400).epsilon(1e-5));
  CHECK(zoned({{box(0, 0, 10, 20), 0, ""}, {box(10.02, 0, 20, 20), 1, ""}}).islands.size() == 2);
}

TEST_CASE("outlines stay inside of what was drawn, and lose vertices that do not matter") {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> jitter(-0.002, 0.002);
  const std::size_t corners = 2000;
  const auto rough_circle = [&](double radius) {
    Ring ring;
    for (std::size_t i = 0; i < corners; ++i) {
      const double turn = 2 * 3.14159265358979 * double(i) / double(corners), r = radius + jitter(random);
      ring.emplace_back(r * std::cos(turn), r * std::sin(turn));
    }
    return ring;
  };
  const Region washer = enclosed({rough_circle(20), rough_circle(8)}, FillRule::even_odd);
  const Zoning zoning = zoned({{washer, 0, ""}});
  REQUIRE(zoning.islands.size() == 1);
  const Polygon& outline = zoning.islands[0].outline;
  const double around = 2 * 3.14159 * (20 + 8);
  CHECK(area(subtract({outline}, washer)) < 1e-5 * around);
  CHECK(area(subtract(washer, {outline})) < 0.003 * around);
  CHECK(outline.outer.size() < corners / 2);
  CHECK(offset(subtract({outline}, washer), -2e-5, 1e-6).empty());
}

TEST_CASE("a gap inside one shape's ground is given to a neighbour") {
  const Zoning zoning =
      zoned({{box(0, 0, 20, 20), {}, "ground"}, {box(0, 0, 10, 20), 0, ""}, {box(10.008, 0, 20, 20), 1, ""}});
  CHECK(zoning.unclaimed.empty());
  REQUIRE(zoning.islands.size() == 1);
  check_partition(zoning.islands[0]);
  CHECK(area(zoning.islands[0].outline) == Approx(400));
}

TEST_CASE("slivers of a zone behind another join that other") {
  const Zoning zoning = zoned({{box(0, 0, 10.006, 10), 0, ""}, {box(0, 0, 10, 10), 1, ""}});
  REQUIRE(zoning.islands.size() == 1);
  REQUIRE(zoning.islands[0].zones.size() == 1);
  CHECK(zoning.islands[0].zones[0].zone == 1);
  CHECK(area(zoning.islands[0].zones[0].polygons) == Approx(100.06));
}

TEST_CASE("areas of no zone are reported with name, place and size") {
  const Zoning zoning = zoned({{box(0, 0, 20, 20), {}, "black"}, {box(0, 0, 10, 20), 0, ""}});
  REQUIRE(zoning.unclaimed.size() == 1);
  CHECK(zoning.unclaimed[0].label == "black");
  CHECK(zoning.unclaimed[0].area == Approx(200).epsilon(1e-3));
  CHECK(zoning.unclaimed[0].place.x() > 9.9);
  CHECK(zoned({{box(0, 0, 10.02, 20), {}, "black"}, {box(0, 0, 10, 20), 0, ""}}).unclaimed.size() == 1);
}

TEST_CASE("specks and pinholes are rounding") {
  Region dotted = box(0, 0, 10, 10);
  dotted = subtract(dotted, box(5, 5, 5.005, 5.005));
  const Zoning zoning = zoned({{dotted, 0, ""}, {box(20, 20, 20.005, 20.005), 0, ""}});
  REQUIRE(zoning.islands.size() == 1);
  CHECK(zoning.islands[0].outline.holes.empty());
  CHECK(area(zoning.islands[0].zones[0].polygons) == Approx(100));
}

TEST_CASE("any pile of shapes gives zones that partition their islands") {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> at(0, 30), jitter(-0.01, 0.01);
  for (int round = 0; round < 60; ++round) {
    std::vector<Painted> shapes;
    double total_before = 0;
    Region whole;
    for (std::size_t i = 0; i < 6; ++i) {
      Ring ring;
      for (int k = 0; k < 5; ++k) ring.emplace_back(at(random), at(random));
      shapes.push_back({enclosed({ring}, FillRule::even_odd), i % 3, ""});
      // A near copy: its borders almost coincide with the first one's.
      for (Vec2& p : ring) p += Vec2(jitter(random), jitter(random));
      shapes.push_back({enclosed({ring}, FillRule::even_odd), (i + 1) % 3, ""});
      for (const std::size_t k : {2 * i, 2 * i + 1}) whole = unite(whole, shapes[k].region);
    }
    total_before = area(whole);
    CAPTURE(round);
    const Zoning zoning = zoned(shapes);
    for (const Island& island : zoning.islands) check_partition(island);
    CHECK(outline_area(layer_of(zoning)) == Approx(total_before).epsilon(2e-3));
  }
}
