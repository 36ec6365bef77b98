#include "core/planner/plan_island.hpp"

#include <catch2/catch.hpp>

#include "core/planner/zones_along.hpp"
#include "tests/core/support/plan_faults.hpp"
#include "tests/core/support/shapes.hpp"

using namespace unicursal::core;
using namespace unicursal::core::test;

namespace {

void check_plan(const IslandPlan& plan, const Polygon& outline, double w) {
  REQUIRE(fault_of(plan, outline, std::vector<Zone>(4), w) == "");
}

}  // namespace

TEST_CASE(
    "a square is filled by one curve of the asked spacing, with nearly the best coverage and no holes") {
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

TEST_CASE("islands of a few cells or fewer get a contour") {
  const double w = 0.5;
  const double side = GENERATE(0.35, 0.5, 0.8, 1.0, 1.3, 1.7, 2.2, 3.0);
  const Polygon square = rectangle(side, side);
  const IslandPlan plan = plan_island(whole(square), one_zone(), options_for(w));
  check_plan(plan, square, w);
  REQUIRE(plan.curves.size() == 1);
  // The path has not shrunk to a point: no bead is wider than twice the asked width.
  CHECK(plan.curves.front().path.total_length() > area(square) / w / 2);
}

TEST_CASE("strips are filled down to the least width, narrower ones are reported as unfilled") {
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

TEST_CASE("a fin that is too thin is left out and reported, and the body is filled") {
  const Polygon body = unite({rectangle(10, 10)}, {{{{10, 5}, {25, 5}, {25, 5.1}, {10, 5.1}}, {}}}).front();
  const IslandPlan plan = plan_island(whole(body), one_zone(), options_for(0.5));
  check_plan(plan, body, 0.5);
  REQUIRE(plan.curves.size() == 1);
  CHECK(plan.unfilled_area == Approx(1.5).epsilon(0.1));
}

TEST_CASE("a neck that is too thin to pass splits the island into two curves") {
  Region two = unite({rectangle(8, 8)}, {{{{7, 4}, {13, 4}, {13, 4.1}, {7, 4.1}}, {}}});
  two = unite(two, {{{{12, 0}, {20, 0}, {20, 8}, {12, 8}}, {}}});
  REQUIRE(two.size() == 1);
  const IslandPlan plan = plan_island(whole(two.front()), one_zone(), options_for(0.5));
  check_plan(plan, two.front(), 0.5);
  CHECK(plan.curves.size() == 2);
}

namespace {

struct Neck {
  double rounds = 0;    ///< length of the curve in the neck ÷ length of the neck
  double width = 0;     ///< mean width of the beads in the neck, mm
  double narrow = 0;    ///< length of all beads that are too narrow, mm
  double unfilled = 0;  ///< mm²
  std::size_t curves = 0;
};

/// Two plates of 6 × 6 mm with a neck of 5 mm between them.
Neck plan_neck(double width, double w) {
  const Polygon left = rectangle(6, 6);
  const Polygon right{{{11, 0}, {17, 0}, {17, 6}, {11, 6}}, {}};
  const Polygon bridge{{{5, 3 - width / 2}, {12, 3 - width / 2}, {12, 3 + width / 2}, {5, 3 + width / 2}},
                       {}};
  const Region island = unite({left, right}, {bridge});
  const IslandPlan plan = plan_island(whole(island.front()), one_zone(), options_for(w));
  check_plan(plan, island.front(), w);
  Neck neck;
  neck.unfilled = plan.unfilled_area;
  neck.curves = plan.curves.size();
  double length = 0, filled = 0;
  for (const PlannedCurve& curve : plan.curves) {
    neck.narrow += curve.narrow_length;
    for (std::size_t i = 0; i < curve.path.size(); ++i) {
      const double x = (curve.path.start(i).x() + curve.path.end(i).x()) / 2;
      if (x < 6.5 || x > 10.5) continue;
      length += curve.path.length(i);
      filled += curve.path.beads[i].area;
    }
  }
  neck.rounds = length / 4;
  neck.width = length > 0 ? filled / length : 0;
  return neck;
}

}  // namespace

TEST_CASE(
    "a neck is passed there and back, with half its width or, if that cannot be laid, with an empty way "
    "back") {
  const double w = 0.5;  // the least width that can be laid is 0.55 w
  const double width = GENERATE(0.5, 0.8, 1.0, 1.5, 2.0);
  const Neck neck = plan_neck(width * w, w);
  INFO(width << " bead widths");
  if (width < 0.55) {
    CHECK(neck.curves == 2);
    CHECK(neck.unfilled == Approx(5 * width * w).epsilon(0.05));
    return;
  }
  CHECK(neck.curves == 1);
  CHECK(neck.unfilled == Approx(0).margin(1e-6));
  CHECK(neck.rounds == Approx(2).margin(0.15));
  CHECK(neck.width == Approx(width * w / 2).epsilon(0.08));
  CHECK(neck.narrow < 1);
}

TEST_CASE("a ring one bead wide is passed once, and no bead is too narrow") {
  const double w = 0.5;
  const Polygon ring{circle({0, 0}, 8.25, 200), {circle({0, 0}, 7.75, 200, false)}};
  const IslandPlan plan = plan_island(whole(ring), one_zone(), options_for(w));
  check_plan(plan, ring, w);
  REQUIRE(plan.curves.size() == 1);
  CHECK(plan.curves.front().path.total_length() == Approx(16 * 3.1416).epsilon(0.02));
  CHECK(plan.curves.front().narrow_length == 0);
}

TEST_CASE("beads wider than the nozzle can lay are reported") {
  // A square of 1.6 bead widths is one small loop.
  const Polygon square = rectangle(0.8, 0.8);
  PlanOptions options = options_for(0.5);
  CHECK(plan_island(whole(square), one_zone(), options).curves.front().wide_length == 0);
  options.max_bead_width = 0.3;
  const PlannedCurve curve = plan_island(whole(square), one_zone(), options).curves.front();
  CHECK(curve.wide_length == Approx(curve.path.total_length()));
}

TEST_CASE("a larger budget gives a better curve, even a spent budget gives a faired one") {
  const Polygon square = rectangle(14, 14);
  const double w = 0.7;
  double last = 0.1;  // an unfaired curve has 0.107 or more
  for (const int steps : {0, 200, 400, 430, 500}) {
    double coverage = 0;
    for (const std::uint64_t seed : {1, 2, 3}) {
      PlanOptions options = options_for(w, seed);
      int left = steps;
      options.budget_spent = [&left] { return left-- <= 0; };
      const IslandPlan plan = plan_island(whole(square), one_zone(), options);
      check_plan(plan, square, w);
      coverage += plan.curves.front().objectives.normalised_coverage / 3;
      const BeadPath& path = plan.curves.front().path;
      CHECK(path.total_length() == Approx(area(square) / w).epsilon(0.02));
      // The recorded effort gives the same curve again.
      options.budget_spent = {};
      options.recorded = plan.effort;
      if (seed == 1 && steps == 0) {
        const IslandPlan again = plan_island(whole(square), one_zone(), options);
        REQUIRE(again.curves.front().path.size() == path.size());
        CHECK(again.curves.front().path.beads[7].position == path.beads[7].position);
        CHECK(again.effort == plan.effort);
      }
    }
    INFO(steps << " steps");
    CHECK(coverage < last + 1e-4);
    last = coverage;
  }
}

TEST_CASE("the curve reaches the ends of thin branches") {
  // A plus with arms 0.7 mm wide, filled with beads of 0.5 mm.
  const Region plus = unite({{{{-10, -0.35}, {10, -0.35}, {10, 0.35}, {-10, 0.35}}, {}}},
                            {{{{-0.35, -10}, {0.35, -10}, {0.35, 10}, {-0.35, 10}}, {}}});
  const IslandPlan plan = plan_island(whole(plus.front()), one_zone(), options_for(0.5));
  check_plan(plan, plus.front(), 0.5);
  REQUIRE(plan.curves.size() == 1);
  CHECK(plan.far_area == Approx(0).margin(0.05));
}

TEST_CASE("equal seeds give equal plans, different seeds different ones") {
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
  CHECK(plan.curves.front().zone_crossings == 2);  // the least number for a closed curve through both
  zones[1].material = 0;                           // with one material zone there is no border to cross
  CHECK(material_changes(path, zones) == 0);
}

TEST_CASE("a curve through k pieces of zones crosses borders 2 (k - 1) times, also if pieces are nested") {
  // Two discs in a plate, and beside them a third disc inside a ring of another zone.
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

TEST_CASE("zones too thin for a curve of their own are crossed by a single curve of the island") {
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
