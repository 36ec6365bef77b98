#include "core/planner/stages.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <numbers>
#include <set>

#include "core/planner/plan_island.hpp"
#include "tests/core/support/shapes.hpp"

using namespace unicursal::core;
using namespace unicursal::core::test;

namespace {

using Place = std::pair<double, double>;

std::set<Place> places(const std::vector<Vec2>& points) {
  std::set<Place> result;
  for (const Vec2& p : points) result.emplace(p.x(), p.y());
  return result;
}

Stages stages_of(const Island& island, const std::vector<Zone>& zones, double w,
                 Preset preset = Preset::best) {
  Stages stages;
  PlanOptions options;
  options.bead_width = w;
  options.stages = &stages;
  options.preset = preset;
  plan_island(island, zones, options);
  return stages;
}

/// A plate of two halves; only the right one asks for directions.
Island two_halves() {
  const Polygon left = rectangle(6, 9), right{{{6, 0}, {12, 0}, {12, 9}, {6, 9}}, {}};
  return {rectangle(12, 9), {{0, {left}}, {1, {right}}}};
}

std::vector<Zone> free_and_aligned(std::size_t second_material) {
  std::vector<Zone> zones(2);
  zones[1].pattern = {PatternKind::angle, std::numbers::pi / 3, {}, false};
  zones[1].material = second_material;
  return zones;
}

}  // namespace

TEST_CASE("every node of the kept graph has three edges, and the first cycle visits all nodes") {
  const Stages stages = stages_of(whole(square_with_hole()), one_zone(), 0.7);
  REQUIRE(stages.cycles.size() == 1);
  const CycleStages& cycle = stages.cycles.front();
  CHECK(2 * cycle.edges.size() == 3 * cycle.nodes.size());
  const std::set<Place> nodes = places(cycle.nodes), visited = places(cycle.first);
  REQUIRE(nodes.size() == cycle.nodes.size());
  for (const Polyline& edge : cycle.edges) {
    REQUIRE(nodes.count({edge.front().x(), edge.front().y()}) == 1);
    REQUIRE(nodes.count({edge.back().x(), edge.back().y()}) == 1);
  }
  // The cycle passes beside nodes of doubled edges, which are rare.
  std::size_t missed = 0;
  for (const Place& node : nodes) missed += 1 - visited.count(node);
  CHECK(missed <= nodes.size() / 100);
  CHECK(cycle.first != cycle.optimised);
  CHECK(signed_area(cycle.first) > 0);
  CHECK(signed_area(cycle.optimised) > 0);
}

TEST_CASE("the asked directions are kept, and no others") {
  const Stages stages = stages_of(two_halves(), free_and_aligned(0), 0.6);
  CHECK(stages.field.size() == Approx(12 * 9 / (0.9 * 0.9)).epsilon(0.1));
  for (const AskedDirection& here : stages.field) {
    INFO(here.point.x() << ' ' << here.point.y());
    if (here.point.x() < 5.7) CHECK(!here.angle);
    if (here.point.x() > 6.3) {
      REQUIRE(here.angle);
      CHECK(*here.angle == Approx(std::numbers::pi / 3));
    }
  }
}

TEST_CASE("each material has its own stages, and those of discarded curves are not kept") {
  const Stages stages = stages_of(two_halves(), free_and_aligned(1), 0.6);
  REQUIRE(stages.cycles.size() == 2);
  const auto beyond = [](const CycleStages& cycle, bool right) {
    return std::count_if(cycle.nodes.begin(), cycle.nodes.end(),
                         [&](const Vec2& n) { return (n.x() > 6) != right; });
  };
  CHECK(beyond(stages.cycles[0], false) == 0);
  CHECK(beyond(stages.cycles[1], true) == 0);
}

TEST_CASE("needles lie along the asked direction, and points have no length") {
  std::vector<Zone> zones(1);
  zones[0].pattern.kind = PatternKind::parallel;
  const Stages aligned = stages_of(whole(square_with_hole()), zones, 0.7, Preset::paper);
  const Stages plain = stages_of(whole(square_with_hole()), one_zone(), 0.7);
  const auto mean_length = [](const Stages& stages) {
    double sum = 0;
    for (const Polyline& needle : stages.cycles.front().needles) sum += (needle[1] - needle[0]).norm();
    return sum / static_cast<double>(stages.cycles.front().needles.size());
  };
  CHECK(mean_length(plain) == 0);
  CHECK(mean_length(aligned) > 0.3);
}

TEST_CASE("of stripes, the loops are kept and the curve that is merged from them") {
  std::vector<Zone> zones(1);
  zones[0].pattern.kind = PatternKind::angle;
  const Stages stages = stages_of(whole(rectangle(12, 12)), zones, 0.6);
  REQUIRE(stages.cycles.size() == 1);
  const CycleStages& cycle = stages.cycles.front();
  CHECK(cycle.nodes.empty());
  CHECK(cycle.edges.size() == 10);  // 20 strands, two in a loop
  for (const Polyline& loop : cycle.edges) CHECK(loop.front() == loop.back());
  CHECK(cycle.optimised.size() > 100);
}
