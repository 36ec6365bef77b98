// Plans of islands that ask for directions everywhere: their curves are made of stripes.
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "core/planner/demands.hpp"
#include "core/planner/plan_island.hpp"
#include "tests/core/support/plan_faults.hpp"
#include "tests/core/support/random_islands.hpp"

using namespace unicursal::core;
using namespace unicursal::core::test;

namespace {

constexpr double pi = std::numbers::pi;

std::vector<Zone> zones_of(PatternKind kind, double angle = 0) {
  std::vector<Zone> zones(1);
  zones[0].pattern.kind = kind;
  zones[0].pattern.angle = angle;
  return zones;
}

IslandPlan plan_of(const Polygon& island, const std::vector<Zone>& zones, const PlanOptions& options) {
  const IslandPlan plan = plan_island(whole(island), zones, options);
  REQUIRE(fault_of(plan, island, zones, options.bead_width) == "");
  REQUIRE(plan.curves.size() == 1);
  return plan;
}

/// A file of directions, removed at the end.
class DirectionFile {
 public:
  /// Writes `angle(point)` in degrees for points all over the box.
  template <typename Angle>
  DirectionFile(const std::string& name, const Box& box, Angle angle)
      : path_(std::filesystem::temp_directory_path() / ("unicursal-" + name + ".csv")) {
    std::ofstream file(path_);
    const double step = box.size().maxCoeff() / 40;
    for (double x = box.min.x(); x <= box.max.x() + step; x += step) {
      for (double y = box.min.y(); y <= box.max.y() + step; y += step)
        file << x << ',' << y << ',' << angle(Vec2(x, y)) * 180 / pi << '\n';
    }
  }
  ~DirectionFile() { std::filesystem::remove(path_); }
  DirectionFile(const DirectionFile&) = delete;
  DirectionFile& operator=(const DirectionFile&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// Plans of random islands with random fields: up to five singularities of half or whole turns, and waves.
void check_random_fields(std::uint64_t first, std::uint64_t count, double largest) {
  for (std::uint64_t k = first; k < first + count; ++k) {
    Random random(k);
    const double w = 0.5;
    const Polygon island = random_island(random, random_scale(random, 1, largest), 3);
    const Box box = bounds(island);
    struct Singularity {
      Vec2 place;
      double turns;
    };
    std::vector<Singularity> singularities;
    for (std::size_t n = random.below(6); n > 0; --n) {
      constexpr double turns[] = {-1, -0.5, 0.5, 1};
      singularities.push_back(
          {{random.uniform(box.min.x(), box.max.x()), random.uniform(box.min.y(), box.max.y())},
           turns[random.below(4)]});
    }
    const double start = random.uniform(0, pi), wave = random.uniform(0, 1), noise = random.uniform(0, 0.35);
    const DirectionFile file("random-field", box, [&](const Vec2& p) {
      double angle = start + wave * std::sin(p.x() + 0.7 * p.y()) + noise * random.uniform(-1, 1);
      for (const Singularity& s : singularities)
        angle += s.turns * std::atan2(p.y() - s.place.y(), p.x() - s.place.x());
      return angle;
    });
    std::vector<Zone> zones = zones_of(PatternKind::field);
    zones[0].pattern.field = file.path();
    CAPTURE(k, area(island));
    const IslandPlan plan = plan_island(whole(island), zones, options_for(w, k));
    REQUIRE(fault_of(plan, island, zones, w) == "");
    for (const PlannedCurve& curve : plan.curves) {
      if (curve.area > 200 * w * w) CHECK(curve.objectives.alignment < 0.55);
    }
  }
}

}  // namespace

TEST_CASE("strands follow one direction more closely than a cell graph lets them, at any angle") {
  const double angle = GENERATE(0.0, 0.4, pi / 4, 1.9);
  const Polygon square = rectangle(20, 20);
  const CurveObjectives o =
      plan_of(square, zones_of(PatternKind::angle, angle), options_for(0.6, 2)).curves.front().objectives;
  CHECK(o.alignment < 0.075);  // 0.14 and more by a cell graph; 0.08 were the rows' ends all round
  CHECK(o.normalised_coverage < 0.0865);
  CHECK(o.width_variation < 0.055);
}

TEST_CASE("strands parallel to a border go round, and across it they end there") {
  const Polygon island = square_with_hole();
  const auto of = [&](PatternKind kind) {
    return plan_of(island, zones_of(kind), options_for(0.4, 3)).curves.front();
  };
  const PlannedCurve around = of(PatternKind::parallel), across = of(PatternKind::orthogonal);
  CHECK(around.objectives.alignment < 0.06);
  CHECK(across.objectives.alignment < 0.25);
  CHECK(around.objectives.normalised_coverage < 0.0865);
  CHECK(across.objectives.normalised_coverage < 0.0905);
  CHECK(std::max(around.farthest, across.farthest) <= 0.4);
}

TEST_CASE("an anisotropic zone gets the direction in which the fewest strands end") {
  const double angle = GENERATE(0.0, 0.3, 2.0);
  const Vec2 u(std::cos(angle), std::sin(angle)), n(-std::sin(angle), std::cos(angle));
  // An L whose long leg lies along u: its principal axis is another.
  const Polygon ell{{Vec2(0, 0), 20 * u, 20 * u + 6 * n, 6 * u + 6 * n, 6 * u + 12 * n, 12 * n}, {}};
  const double found = direction_of_fewest_ends({0, {ell}});
  CHECK(std::remainder(found - angle, pi) == Approx(0).margin(1e-6));
  const CurveObjectives o =
      plan_of(ell, zones_of(PatternKind::anisotropic), options_for(0.5, 4)).curves.front().objectives;
  CHECK(o.anisotropy < 0.24);
  CHECK(o.normalised_coverage < 0.0875);
}

TEST_CASE("the same plan of stripes comes from any number of threads, and again from its effort") {
  const Polygon island = square_with_hole();
  const std::vector<Zone> zones = zones_of(PatternKind::parallel);
  const int steps = GENERATE(0, 20, 60, 100000);
  PlanOptions options = options_for(0.4, 5);
  int left = steps;
  options.budget_spent = [&left] { return left-- <= 0; };
  const IslandPlan plan = plan_of(island, zones, options);
  options.budget_spent = {};
  options.recorded = plan.effort;
  options.threads = 2;
  const IslandPlan again = plan_of(island, zones, options);
  CHECK(again.effort == plan.effort);
  const auto &one = plan.curves.front().path.beads, &other = again.curves.front().path.beads;
  REQUIRE(one.size() == other.size());
  for (std::size_t i = 0; i < one.size(); ++i) REQUIRE(one[i].position == other[i].position);
}

TEST_CASE("random fields with singularities, noise and waves: plans are sound") {
  check_random_fields(3'000'000, 12, 8);
}

TEST_CASE("hundreds of random fields with singularities, noise and waves: plans are sound", "[long]") {
  check_random_fields(0, 200, 10);
}

TEST_CASE("zones of one material with and without directions each get a curve of their kind") {
  const Polygon left = rectangle(10, 12), right{{{10, 0}, {22, 0}, {22, 12}, {10, 12}}, {}};
  const Island island{rectangle(22, 12), {{0, {left}}, {1, {right}}}};
  std::vector<Zone> zones(2);
  zones[0].pattern.kind = PatternKind::isotropic;
  zones[1].pattern = {PatternKind::angle, 0.5, {}, false};
  const IslandPlan plan = plan_island(island, zones, options_for(0.5, 6));
  REQUIRE(fault_of(plan, island.outline, zones, 0.5) == "");
  REQUIRE(plan.curves.size() == 1);
  const CurveObjectives& o = plan.curves.front().objectives;
  CHECK(o.alignment < 0.09);  // 0.15 and more if one cell graph serves both
  CHECK(o.isotropy < 0.001);
  CHECK(o.normalised_coverage < 0.0875);
}
