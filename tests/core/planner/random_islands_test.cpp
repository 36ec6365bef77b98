// The plan of any island is sound: no crash, and no curve leaves the island, meets itself or loses area.
#include "tests/core/support/random_islands.hpp"

#include <catch2/catch.hpp>
#include <future>

#include "core/planner/plan_island.hpp"
#include "tests/core/support/plan_faults.hpp"
#include "tests/paths.hpp"

using namespace unicursal::core;
using namespace unicursal::core::test;

namespace {

/// Each island has its own seed, so that an island that fails can be reproduced alone.
void check_islands(std::uint64_t first, std::uint64_t count, double largest) {
  for (std::uint64_t k = first; k < first + count; ++k) {
    Random random(k);
    const int kind = static_cast<int>(k % island_kinds);
    const Polygon outline = random_island_of_kind(random, kind, random_scale(random, 0.2, largest));
    CAPTURE(k, kind, area(outline));
    const IslandPlan plan = plan_island(whole(outline), one_zone(), options_for(0.5, k));
    REQUIRE(fault_of(plan, outline, one_zone(), 0.5) == "");
  }
}

struct Patterned {
  Island island;
  std::vector<Zone> zones;
};

Patterned patterned(std::uint64_t seed, double largest) {
  Random random(seed);
  const int kind = static_cast<int>(seed % island_kinds);
  const Polygon outline = random_island_of_kind(random, kind, random_scale(random, 0.5, largest));
  Island island = random_zones(random, outline);
  return {std::move(island), random_patterns(random, unicursal::test::data_folder() / "directions.csv")};
}

void check_patterned(std::uint64_t first, std::uint64_t count, double largest) {
  for (std::uint64_t k = first; k < first + count; ++k) {
    const Patterned p = patterned(k, largest);
    CAPTURE(k, area(p.island.outline), p.island.zones.size());
    const IslandPlan plan = plan_island(p.island, p.zones, options_for(0.5, k));
    REQUIRE(fault_of(plan, p.island.outline, p.zones, 0.5) == "");
  }
}

void require_same(const IslandPlan& a, const IslandPlan& b) {
  REQUIRE(a.effort == b.effort);
  REQUIRE(a.unfilled_area == b.unfilled_area);
  REQUIRE(a.far_area == b.far_area);
  REQUIRE(a.curves.size() == b.curves.size());
  for (std::size_t c = 0; c < a.curves.size(); ++c) {
    const auto &x = a.curves[c].path.beads, &y = b.curves[c].path.beads;
    REQUIRE(std::equal(x.begin(), x.end(), y.begin(), y.end(), [](const Bead& p, const Bead& q) {
      return p.position == q.position && p.area == q.area && p.zone == q.zone;
    }));
    REQUIRE(a.curves[c].objectives.coverage == b.curves[c].objectives.coverage);
  }
}

}  // namespace

TEST_CASE("random islands of every kind: plans are sound, and no area is lost") {
  check_islands(1'000'000, 70, 4);
}

TEST_CASE("random zones, patterns and materials: plans are sound, and no area is lost") {
  check_patterned(2'000'000, 35, 4);
}

TEST_CASE("equal arguments give equal plans, in sequence and from two threads at once") {
  for (const std::uint64_t seed : {3u, 10u, 15u}) {
    const Patterned p = patterned(seed, 4);
    const IslandPlanner planner(p.zones);
    const auto plan = [&] { return planner.plan(p.island, 0.1, options_for(0.5, seed)); };
    const IslandPlan first = plan();
    REQUIRE(!first.curves.empty());
    require_same(first, plan());
    auto one = std::async(std::launch::async, plan), two = std::async(std::launch::async, plan);
    require_same(first, one.get());
    require_same(first, two.get());
  }
}

TEST_CASE("ten thousand random islands: plans are sound, and no area is lost", "[long]") {
  check_islands(0, 10'000, 5);
}

TEST_CASE("hundreds of random zones, patterns and materials: plans are sound, and no area is lost",
          "[long]") {
  check_patterned(0, 700, 7);
}
