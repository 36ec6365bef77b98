#include "core/planner/fill_thin.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <limits>
#include <utility>

#include "core/planner/bare.hpp"
#include "core/planner/plan_island.hpp"
#include "tests/core/support/plan_faults.hpp"
#include "tests/core/support/shapes.hpp"
#include "tests/core/support/thin_shapes.hpp"

using namespace unicursal::core;
using namespace unicursal::core::test;

namespace {

constexpr double w = 0.8, least = 0.36, greatest = 1.6;

PlanOptions options_with(int perimeters = 0) {
  PlanOptions options;
  options.bead_width = w;
  options.min_bead_width = least;
  options.max_bead_width = greatest;
  options.perimeters = perimeters;
  return options;
}

IslandPlan plan_of(const Polygon& outline, int perimeters = 0) {
  const IslandPlan plan = plan_island(whole(outline), one_zone(), options_with(perimeters));
  REQUIRE(fault_of(plan, outline, one_zone(), w) == "");
  REQUIRE(plan.curves.size() == 1);
  return plan;
}

double distance(const BeadPath& path, const Vec2& p) {
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < path.size(); ++i)
    nearest = std::min(nearest, distance_to_segment(p, path.start(i), path.end(i)));
  return nearest;
}

/// The width of the bead that is nearest to a point and lays something.
double width_at(const BeadPath& path, const Vec2& p) {
  double nearest = std::numeric_limits<double>::infinity(), width = 0;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const double d = distance_to_segment(p, path.start(i), path.end(i));
    if (path.beads[i].area > 0 && d < nearest) nearest = d, width = path.width(i);
  }
  return width;
}

/// The share of the beads' length whose width is not between the least and the greatest.
double share_out_of_range(const BeadPath& path) {
  double out = 0;
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (path.beads[i].area > 0 && (path.width(i) < 0.95 * least || path.width(i) > greatest))
      out += path.length(i);
  }
  return out / path.total_length();
}

/// The greatest distance from the curve, among points of the outline on a fine grid that half a bead's width
/// of border does not hide.
double barest(const BeadPath& path, const Polygon& outline) {
  double farthest = 0;
  const Box all = bounds(outline);
  for (double x = all.min.x() + 0.05; x < all.max.x(); x += 0.1) {
    for (double y = all.min.y() + 0.05; y < all.max.y(); y += 0.1) {
      if (contains(outline, {x, y})) farthest = std::max(farthest, distance(path, {x, y}));
    }
  }
  return farthest;
}

}  // namespace

TEST_CASE("bars of 0.5 to 6 bead widths are filled to their ends, whatever the number of perimeters") {
  const double wall = GENERATE(0.5, 0.7, 0.9, 1.0, 1.2, 1.5, 2.0, 2.4, 2.5, 2.6, 3.0, 3.5, 4.0, 4.5, 6.0) * w;
  const int perimeters = GENERATE(0, 1, 2);
  CAPTURE(wall / w, perimeters);
  const Polygon bar = rectangle(20, wall);
  const IslandPlan plan = plan_of(bar, perimeters);
  const BeadPath& path = plan.curves.front().path;
  const bool thin = wall < 4.4 * w;
  CHECK(share_out_of_range(path) < (thin ? 0.02 : 0.06));
  // Half the width of a bead there; the cell graph leaves more.
  const double end = thin ? std::max(w / 2, wall / 4) + 0.005 : 0.85 * w;
  for (const double x : {0.0, 20.0}) CHECK(distance(path, {x, wall / 2}) < end);
  CHECK(barest(path, bar) < 0.85 * w);
}

TEST_CASE(
    "frames, crosses, ladders and combs of thin walls are covered by one closed curve of beads that can be "
    "laid",
    "[optimised]") {
  const double wall = GENERATE(0.5, 0.8, 1.0, 1.3, 1.75, 2.25, 2.5, 2.75, 3.25) * w;
  CAPTURE(wall / w);
  for (const Polygon& outline : {frame(wall), cross_of_bars(wall), ladder(wall), comb_of_teeth(wall)}) {
    CAPTURE(area(outline));
    const BeadPath path = plan_of(outline).curves.front().path;
    CHECK(share_out_of_range(path) < 0.06);
    CHECK(barest(path, outline) < 1.2 * w);
  }
}

TEST_CASE("short rungs and corners of walls of three to five bead widths are not left bare between strands") {
  // Of a rung that is cut in the middle, each half may be too short for the inner two of four strands.
  const auto [outline, perimeters] =
      GENERATE(std::pair(turned(ladder(3.2 * w), 31), 0), std::pair(turned(ladder(3.6 * w), 31), 0),
               std::pair(frame(4.7 * w), 2));
  CAPTURE(area(outline), perimeters);
  const Bare bare = look_for_bare(plan_of(outline, perimeters), outline, w, least);
  CHECK(bare.area < 0.01 * area(outline));
  CHECK(bare.axis_length < 2.5 * w);
}

TEST_CASE("the bead along a wall of one bead runs on its axis") {
  // The way back lies beside it. What is laid aside of the axis is missing on the other side.
  const BeadPath path = plan_of(rectangle(20, 0.5 * w)).curves.front().path;
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (path.beads[i].area > 0) CHECK(path.start(i).y() == Approx(0.25 * w).margin(0.01 * w));
  }
}

TEST_CASE("what strands leave bare is measured over the island as it is") {
  // A strand along the middle of the left half of a bar.
  const Polygon bar = rectangle(20, 1);
  IslandPlan plan;
  CHECK(look_for_bare(plan, bar, w, least).area == 20);
  plan.curves.resize(1);
  plan.curves[0].path.beads = {{{0.4, 0.5}, 10, 0}, {{10, 0.5}, 0, 0}};
  const Bare bare = look_for_bare(plan, bar, w, least);
  CHECK(bare.area == Approx(20 - 10 - 0.75 * w).epsilon(0.02));
  // The axis ends half a width before the bar's end, in two branches into its corners.
  CHECK(bare.axis_length == Approx(20 - 10 - 0.75 * w - 0.5 + 2 * 0.45).epsilon(0.1));
}

TEST_CASE("a wall that is too narrow for two beads gets one that is as wide as it, and an empty way back") {
  const double wall = GENERATE(0.5, 0.6, 0.8) * w;
  const BeadPath path = plan_of(rectangle(20, wall)).curves.front().path;
  double laying = 0, empty = 0;
  for (std::size_t i = 0; i < path.size(); ++i) (path.beads[i].area > 0 ? laying : empty) += path.length(i);
  CHECK(laying == Approx(20).margin(1));
  CHECK(empty == Approx(20).margin(1));
  CHECK(width_at(path, {10, wall / 2}) == Approx(wall).epsilon(0.02));
}

TEST_CASE("rings of one bead are a single strand, wider ones run there and back, and no stretch is bare") {
  const double bead = GENERATE(0.5, 0.8, 1.2);
  const double wall = GENERATE(0.65, 0.8, 0.95, 1.0, 1.1, 1.3, 1.7, 2.2, 3.0) * bead;
  if (wall < least) return;
  CAPTURE(bead, wall / bead);
  const Polygon ring = tube(8, wall);
  PlanOptions options = options_with();
  options.bead_width = bead;
  const IslandPlan plan = plan_island(whole(ring), one_zone(), options);
  REQUIRE(fault_of(plan, ring, one_zone(), bead) == "");
  REQUIRE(plan.curves.size() == 1);
  const BeadPath& path = plan.curves.front().path;
  const double round = 2 * 3.14159 * (8 - wall / 2);
  if (wall < 1.45 * bead) CHECK(path.total_length() == Approx(round).epsilon(0.02));
  if (wall > 1.55 * bead) CHECK(path.total_length() > 1.8 * round);
  CHECK(share_out_of_range(path) < 0.05);
  for (int k = 0; k < 360; ++k) {
    const double turn = 3.14159 / 180 * k;
    REQUIRE(distance(path, (8 - wall / 2) * Vec2(std::cos(turn), std::sin(turn))) < 0.75 * bead);
  }
}

TEST_CASE("a wedge is filled up to where it is too narrow, and the rest is reported") {
  const double end = GENERATE(1.0, 2.0, 3.0, 5.0) * w;
  const IslandPlan plan = plan_of(wedge(end));
  const BeadPath& path = plan.curves.front().path;
  const double first = 40 * least / end;
  CHECK(plan.unfilled_area == Approx(first * least / 2).epsilon(0.15));
  CHECK(distance(path, {first, 0}) < w / 2);
  for (double x = first + 0.4; x < 39.6; x += 0.2) REQUIRE(distance(path, {x, 0}) < 0.85 * w);
  CHECK(share_out_of_range(path) < 0.03);
}

TEST_CASE("random islands with thin walls are filled by sound curves, with the same bytes for more threads") {
  Random random(31);
  for (int k = 0; k < 25; ++k) {
    // Random bars on a plate, so that walls meet at all angles.
    Region region;
    for (std::size_t n = 0, bars = 2 + random.below(6); n < bars; ++n) {
      const Vec2 a(random.uniform(0, 15), random.uniform(0, 15)),
          b(random.uniform(0, 15), random.uniform(0, 15));
      const Vec2 aside = random.uniform(0.25, 1.6) * w * perpendicular((b - a).normalized());
      region = unite(region, {{{a - aside, b - aside, b + aside, a + aside}, {}}});
    }
    const Polygon island = *std::max_element(
        region.begin(), region.end(), [](const Polygon& l, const Polygon& r) { return area(l) < area(r); });
    CAPTURE(k, area(island));
    PlanOptions options = options_with(k % 3);
    const IslandPlan plan = plan_island(whole(island), one_zone(), options);
    REQUIRE(fault_of(plan, island, one_zone(), w) == "");
    options.threads = 2;
    const IslandPlan again = plan_island(whole(island), one_zone(), options);
    REQUIRE(again.curves.size() == plan.curves.size());
    for (std::size_t c = 0; c < plan.curves.size(); ++c) {
      const BeadPath &one = plan.curves[c].path, &two = again.curves[c].path;
      REQUIRE(one.size() == two.size());
      for (std::size_t i = 0; i < one.size(); ++i) {
        REQUIRE(one.beads[i].position == two.beads[i].position);
        REQUIRE(one.beads[i].area == two.beads[i].area);
      }
    }
  }
}
