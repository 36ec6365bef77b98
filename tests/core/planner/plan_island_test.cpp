#include "core/planner/plan_island.hpp"

#include <catch2/catch.hpp>

#include "core/planner/zones_along.hpp"
#include "tests/core/support/plan_faults.hpp"
#include "tests/core/support/shapes.hpp"

using namespace unicursal::core;
using namespace unicursal::core::test;

namespace {

PlanOptions options_for(double w, std::uint64_t seed = 1) {
  PlanOptions options;
  options.bead_width = w;
  options.min_bead_width = 0.55 * w;
  options.seed = seed;
  return options;
}

void check_plan(const IslandPlan& plan, const Polygon& outline, double w) {
  REQUIRE(fault_of(plan, outline, std::vector<Zone>(4), w) == "");
}

}  // namespace

TEST_CASE("a square is one curve of the asked spacing, near the limit of coverage, without holes") {
  const double w = GENERATE(0.45, 0.8);
  const Polygon square = rectangle(14, 14);
  const IslandPlan plan = plan_island(whole(square), one_zone(), options_for(w));
  check_plan(plan, square, w);
  REQUIRE(plan.curves.size() == 1);
  CHECK(plan.far_area == 0);
  CHECK(plan.unfilled_area == 0);
  const PlannedCurve& curve = plan.curves.front();
  CHECK(curve.area / curve.path.total_length() == Approx(w).epsilon(0.03));
  CHECK(curve.objectives.normalised_coverage < 0.090);
  CHECK(curve.objectives.normalised_coverage > 1.0 / 12);
  CHECK(curve.farthest < 1.2 * w);
}

TEST_CASE("islands of a few cells or less get the smallest sensible closed path") {
  const double w = 0.5;
  const double side = GENERATE(0.35, 0.5, 0.8, 1.0, 1.3, 1.7, 2.2, 3.0);
  const Polygon square = rectangle(side, side);
  const IslandPlan plan = plan_island(whole(square), one_zone(), options_for(w));
  check_plan(plan, square, w);
  REQUIRE(plan.curves.size() == 1);
  // Not shrunk to a point: no bead wider than twice what was asked.
  CHECK(plan.curves.front().path.total_length() > area(square) / w / 2);
}

TEST_CASE("strips are filled down to the least width, and told below it") {
  const double w = 0.5;
  const double width = GENERATE(0.1, 0.2, 0.26, 0.35, 0.5, 0.75, 1.0, 1.5, 2.0);
  const Polygon strip = rectangle(20, width);
  const IslandPlan plan = plan_island(whole(strip), one_zone(), options_for(w));
  check_plan(plan, strip, w);
  if (width < 0.55 * w) {
    CHECK(plan.curves.empty());
    CHECK(plan.unfilled_area == Approx(area(strip)));
  } else if (width > 0.3) {
    REQUIRE(plan.curves.size() == 1);
    CHECK(plan.far_area == Approx(0).margin(0.02));
  }
}

TEST_CASE("a fin too thin to lay is left out and told, the body is filled") {
  const Polygon body = unite({rectangle(10, 10)}, {{{{10, 5}, {25, 5}, {25, 5.1}, {10, 5.1}}, {}}}).front();
  const IslandPlan plan = plan_island(whole(body), one_zone(), options_for(0.5));
  check_plan(plan, body, 0.5);
  REQUIRE(plan.curves.size() == 1);
  CHECK(plan.unfilled_area == Approx(1.5).epsilon(0.1));
}

TEST_CASE("a neck too thin to pass makes two curves") {
  Region two = unite({rectangle(8, 8)}, {{{{7, 4}, {13, 4}, {13, 4.1}, {7, 4.1}}, {}}});
  two = unite(two, {{{{12, 0}, {20, 0}, {20, 8}, {12, 8}}, {}}});
  REQUIRE(two.size() == 1);
  const IslandPlan plan = plan_island(whole(two.front()), one_zone(), options_for(0.5));
  check_plan(plan, two.front(), 0.5);
  CHECK(plan.curves.size() == 2);
}

TEST_CASE("thin branches do not starve: the curve reaches their ends") {
  // A plus of arms 0.7 mm wide, beads of 0.5 mm.
  const Region plus = unite({{{{-10, -0.35}, {10, -0.35}, {10, 0.35}, {-10, 0.35}}, {}}},
                            {{{{-0.35, -10}, {0.35, -10}, {0.35, 10}, {-0.35, 10}}, {}}});
  const IslandPlan plan = plan_island(whole(plus.front()), one_zone(), options_for(0.5));
  check_plan(plan, plus.front(), 0.5);
  REQUIRE(plan.curves.size() == 1);
  CHECK(plan.far_area == Approx(0).margin(0.05));
}

TEST_CASE("the plan is the same for the same seed and another for another") {
  const Island island = whole(square_with_hole());
  const auto beads = [&](std::uint64_t seed) {
    return plan_island(island, one_zone(), options_for(0.6, seed)).curves.front().path.beads;
  };
  const auto first = beads(1), again = beads(1), other = beads(2);
  REQUIRE(first.size() == again.size());
  for (std::size_t i = 0; i < first.size(); ++i) {
    REQUIRE(first[i].position == again[i].position);
    REQUIRE(first[i].area == again[i].area);
  }
  CHECK((other.size() != first.size() || other[0].position != first[0].position));
}

TEST_CASE("beads are cut at the borders of zones and keep their areas") {
  const Polygon left{{{0, 0}, {5, 0}, {5, 10}, {0, 10}}, {}}, right{{{5, 0}, {10, 0}, {10, 10}, {5, 10}}, {}};
  const Island island{rectangle(10, 10), {{0, {left}}, {1, {right}}}};
  std::vector<Zone> zones(2);
  zones[1].material = 1;
  const IslandPlan plan = plan_island(island, zones, options_for(0.5));
  check_plan(plan, island.outline, 0.5);
  const BeadPath& path = plan.curves.front().path;
  double in_left = 0;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const Vec2 middle = (path.start(i) + path.end(i)) / 2;
    REQUIRE(path.beads[i].zone == (middle.x() < 5 ? 0 : 1));
    const double low = std::min(path.start(i).x(), path.end(i).x()),
                 high = std::max(path.start(i).x(), path.end(i).x());
    REQUIRE((high < 5 + 2e-3 || low > 5 - 2e-3));
    if (path.beads[i].zone == 0) in_left += path.beads[i].area;
  }
  CHECK(in_left == Approx(50).epsilon(0.02));
  CHECK(plan.curves.front().zone_crossings == material_changes(path, zones));
  CHECK(plan.curves.front().zone_crossings == 2);  // no closed curve through both can do with less
  zones[1].material = 0;                           // one material zone: nothing to cross
  CHECK(material_changes(path, zones) == 0);
}

TEST_CASE("a curve through k pieces of zones crosses 2 (k - 1) times, nested pieces too") {
  // Two discs in a plate, a third beside them that lies within another zone's ring.
  const Polygon plate = rectangle(24, 12);
  const Region discs = enclosed({circle({6, 6}, 3, 60), circle({17, 6}, 4, 60)}, FillRule::non_zero);
  const Region core = enclosed({circle({17, 6}, 2, 40)}, FillRule::non_zero);
  const Island island{plate, {{0, subtract({plate}, discs)}, {1, subtract(discs, core)}, {2, core}}};
  std::vector<Zone> zones(3);
  zones[1].material = 1;
  zones[2].material = 2;
  const IslandPlan plan = plan_island(island, zones, options_for(0.45));
  check_plan(plan, plate, 0.45);
  REQUIRE(plan.curves.size() == 1);
  CHECK(plan.curves.front().zone_crossings == 6);
  CHECK(plan.far_area == 0);
}

TEST_CASE("zones too thin for a curve of their own are crossed by the island's one curve") {
  // Stripes of a third of a bead.
  std::vector<Polygon> even, odd;
  for (int k = 0; k < 60; ++k) {
    const double x = 0.15 * k;
    (k % 2 == 0 ? even : odd).push_back({{{x, 0}, {x + 0.15, 0}, {x + 0.15, 8}, {x, 8}}, {}});
  }
  const Island island{rectangle(9, 8), {{0, even}, {1, odd}}};
  std::vector<Zone> zones(2);
  zones[1].material = 1;
  const IslandPlan plan = plan_island(island, zones, options_for(0.45));
  check_plan(plan, island.outline, 0.45);
  REQUIRE(plan.curves.size() == 1);
  CHECK(plan.curves.front().zone_crossings > 40);
}
