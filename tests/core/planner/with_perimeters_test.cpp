#include "core/planner/with_perimeters.hpp"

#include <catch2/catch.hpp>

#include "core/planner/plan_island.hpp"
#include "tests/core/support/shapes.hpp"

using namespace unicursal::core;
using namespace unicursal::core::test;

namespace {

constexpr double w = 0.5;

PlanOptions options_with(int perimeters, std::uint64_t seed = 1) {
  PlanOptions options;
  options.bead_width = w;
  options.min_bead_width = 0.55 * w;
  options.perimeters = perimeters;
  options.seed = seed;
  return options;
}

/// Checks that curves are closed, simple and inside, that no area is lost, and that there are no holes.
void check_plan(const IslandPlan& plan, const Polygon& outline) {
  double filled = 0;
  for (const PlannedCurve& curve : plan.curves) {
    REQUIRE(curve.self_intersections == 0);
    REQUIRE(curve.outside_segments == 0);
    REQUIRE(curve.faired);
    REQUIRE(curve.path.total_area() == Approx(curve.area).epsilon(1e-9).margin(1e-6 * w * w));
    for (const Bead& bead : curve.path.beads) REQUIRE(bead.area >= -1e-9);
    filled += curve.area;
  }
  REQUIRE(filled + plan.unfilled_area == Approx(area(outline)).margin(1e-5 * w * w + 1e-9 * area(outline)));
}

/// The share of the border along which a strand runs half a bead width inside, within 5 %; by length of the
/// strand.
double followed_share(const BeadPath& path, const Polygon& outline) {
  double followed = 0;
  const double step = 0.02;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const auto pieces = std::max(1.0, std::ceil(path.length(i) / step));
    for (double k = 0.5; k < pieces; ++k) {
      const double d =
          distance_to_border(outline, path.start(i) + k / pieces * (path.end(i) - path.start(i)));
      if (std::abs(d - w / 2) < 0.05 * w / 2) followed += path.length(i) / pieces;
    }
  }
  return followed / perimeter(outline);
}

std::vector<Zone> two_materials() {
  std::vector<Zone> zones(2);
  zones[1].material = 1;
  return zones;
}

}  // namespace

TEST_CASE("one, two or three contours and the fill are one curve that follows the border") {
  const int count = GENERATE(1, 2, 3);
  const Polygon square = square_with_hole();
  const IslandPlan plan = plan_island(whole(square), one_zone(), options_with(count));
  check_plan(plan, square);
  REQUIRE(plan.curves.size() == 1);
  const PlannedCurve& curve = plan.curves.front();
  CHECK(curve.perimeters == count);
  CHECK(plan.far_area == 0);
  CHECK(plan.unfilled_area == 0);
  CHECK(curve.area / curve.path.total_length() == Approx(w).epsilon(0.04));
  // The ring is shorter than the border at its four corners, and each of the two rings is opened once.
  const double ring = perimeter(square.outer) - 4 * w + perimeter(square.holes[0]) + 3.14 * w;
  CHECK(followed_share(curve.path, square) * perimeter(square) > ring - 2 * w - 0.01 * ring);
}

TEST_CASE("without contours no strand follows the border that closely") {
  const IslandPlan plan = plan_island(whole(square_with_hole()), one_zone(), options_with(0));
  CHECK(plan.curves.front().perimeters == 0);
  CHECK(followed_share(plan.curves.front().path, square_with_hole()) < 0.5);
}

TEST_CASE(
    "if more contours are asked for than fit, contours fill the island, and the plan reports how many") {
  const IslandPlan plan = plan_island(whole(rectangle(10, 4)), one_zone(), options_with(20));
  check_plan(plan, rectangle(10, 4));
  REQUIRE(plan.curves.size() == 1);
  CHECK(plan.curves.front().perimeters == 4);
  CHECK(plan.far_area == 0);
}

TEST_CASE("specks and strips get as many contours as fit") {
  const double width = GENERATE(0.35, 0.5, 0.8, 1.1, 1.5, 1.9, 2.3, 3.0);
  for (const Polygon& island : {rectangle(width, width), rectangle(15, width)}) {
    const IslandPlan plan = plan_island(whole(island), one_zone(), options_with(2));
    check_plan(plan, island);
    REQUIRE(plan.curves.size() == 1);
    CHECK(plan.far_area == Approx(0).margin(0.02));
    CHECK(plan.curves.front().path.total_length() > area(island) / w / 2);
  }
}

TEST_CASE("the fills on both sides of a neck and their contour are one curve") {
  const double neck = GENERATE(0.7, 1.2, 1.9, 2.5) * w;
  Region two = unite({rectangle(7, 7)}, {{{{6, 3}, {11, 3}, {11, 3 + neck}, {6, 3 + neck}}, {}}});
  two = unite(two, {{{{10, 0}, {17, 0}, {17, 7}, {10, 7}}, {}}});
  const IslandPlan plan = plan_island(whole(two.front()), one_zone(), options_with(2));
  check_plan(plan, two.front());
  REQUIRE(plan.curves.size() == 1);
  CHECK(plan.curves.front().perimeters == 2);
  CHECK(plan.far_area == Approx(0).margin(0.02));
}

TEST_CASE("each material traces its part of the outline, and each border is crossed twice") {
  const int count = GENERATE(1, 2, 3);
  const Polygon left{{{0, 0}, {8, 0}, {8, 12}, {0, 12}}, {}}, right{{{8, 0}, {16, 0}, {16, 12}, {8, 12}}, {}};
  const Island island{rectangle(16, 12), {{0, {left}}, {1, {right}}}};
  const IslandPlan plan = plan_island(island, two_materials(), options_with(count));
  check_plan(plan, island.outline);
  REQUIRE(plan.curves.size() == 1);
  const PlannedCurve& curve = plan.curves.front();
  CHECK(curve.perimeters == (count < 3 ? 2 : 4));
  CHECK(curve.zone_crossings == 2);
  CHECK(plan.far_area == 0);
  // The strands miss four corners, two gaps of a bead at each end of the border, and one opening each.
  CHECK(followed_share(curve.path, island.outline) * 56 > 56 - 4 * w - 4 * w - 2 * w - 0.6);
  double in_left = 0;
  for (const Bead& bead : curve.path.beads) in_left += bead.zone == 0 ? bead.area : 0;
  CHECK(in_left == Approx(96).epsilon(0.01));
}

TEST_CASE("a material that lies inside another has no part of the outline") {
  const Polygon plate = rectangle(16, 16);
  const Region disc{{circle({8, 8}, 4, 60), {}}};
  const Island island{plate, {{0, subtract({plate}, disc)}, {1, disc}}};
  const IslandPlan plan = plan_island(island, two_materials(), options_with(2));
  check_plan(plan, plate);
  REQUIRE(plan.curves.size() == 1);
  CHECK(plan.curves.front().perimeters == 2);
  CHECK(plan.curves.front().zone_crossings == 2);
  CHECK(followed_share(plan.curves.front().path, plate) * 64 > 64 - 4 * w - w - 0.6);
}

TEST_CASE("stripes too thin for a curve of their own are crossed by contours around all of them") {
  std::vector<Polygon> even, odd;
  for (int k = 0; k < 40; ++k) {
    const double x = 0.15 * k;
    (k % 2 == 0 ? even : odd).push_back({{{x, 0}, {x + 0.15, 0}, {x + 0.15, 8}, {x, 8}}, {}});
  }
  const Island island{rectangle(6, 8), {{0, even}, {1, odd}}};
  const IslandPlan plan = plan_island(island, two_materials(), options_with(2));
  check_plan(plan, island.outline);
  REQUIRE(plan.curves.size() == 1);
  CHECK(plan.curves.front().perimeters == 2);
  CHECK(plan.curves.front().zone_crossings > 150);  // two contours, there and back
  CHECK(followed_share(plan.curves.front().path, island.outline) * 28 > 28 - 4 * w - w - 0.6);
}

TEST_CASE("random islands with contours: plans are sound, no area is lost, and there are no holes") {
  Random random(77);
  int laid = 0;
  for (int k = 0; k < 30; ++k) {
    const Polygon island = random_island(random, random.uniform(0.3, 6), 6);
    CAPTURE(k, area(island));
    const IslandPlan plan =
        plan_island(whole(island), one_zone(), options_with(1 + k % 3, static_cast<std::uint64_t>(k)));
    check_plan(plan, island);
    // Sines differ in their last digit between processors, so that the islands and their curves differ, too:
    // what is allowed is a spot that is smaller than a half of the square of a bead width, not what one
    // processor leaves.
    CHECK(plan.far_area < 0.4 * w * w);
    for (const PlannedCurve& curve : plan.curves) laid += curve.perimeters > 0;
  }
  CHECK(laid > 25);
}

TEST_CASE("many random islands with contours: plans are sound, and no area is lost", "[long]") {
  Random random(79);
  for (int k = 0; k < 1000; ++k) {
    const Polygon island = random_island(random, random.uniform(0.2, 6), 8);
    CAPTURE(k, area(island));
    check_plan(plan_island(whole(island), one_zone(), options_with(1 + k % 3, static_cast<std::uint64_t>(k))),
               island);
  }
}
