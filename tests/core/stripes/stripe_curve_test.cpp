#include "core/stripes/stripe_curve.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <numbers>

#include "core/curve/alignment.hpp"
#include "core/curve/clearance.hpp"
#include "core/stripes/merge.hpp"
#include "tests/core/support/fields.hpp"
#include "tests/core/support/random_islands.hpp"

using namespace unicursal::core;
using namespace unicursal::core::test;

namespace {

constexpr double pi = std::numbers::pi, w = 0.5;

using Angle = std::function<double(const Vec2&)>;

/// Fields over a square of 16 mm, each difficult in its own way.
struct Named {
  const char* name;
  Angle angle;
};

std::vector<Named> fields() {
  static Random random(7);
  const auto turn = [](const Vec2& p, const Vec2& c) { return std::atan2(p.y() - c.y(), p.x() - c.x()); };
  return {
      {"one direction", [](const Vec2&) { return 0.4; }},
      {"a source",
       [=](const Vec2& p) {
         return turn(p, {8.1, 7.7});
       }},
      {"a vortex",
       [=](const Vec2& p) {
         return turn(p, {8.1, 7.7}) + pi / 2;
       }},
      {"a saddle",
       [=](const Vec2& p) {
         return -turn(p, {8.1, 7.7});
       }},
      {"two halves of a singularity",
       [=](const Vec2& p) {
         return turn(p, {5.3, 8.2}) / 2 + turn(p, {11.1, 8.4}) / 2;
       }},
      {"a jump", [](const Vec2& p) { return p.x() < 8 ? 0.1 : 1.4; }},
      {"noise of 20 degrees", [](const Vec2& p) { return 0.3 + 0.1 * p.x() + random.uniform(-0.6, 0.6); }},
      {"waves", [](const Vec2& p) { return 0.6 * std::sin(p.x()) + 0.5 * std::cos(0.8 * p.y()); }},
  };
}

}  // namespace

TEST_CASE("stripes along any field become one simple curve inside, through all loops") {
  const Polygon square = rectangle(16, 16);
  const BorderIndex border(square, w);
  for (const Named& field : fields()) {
    CAPTURE(field.name);
    const auto found = stripe_curve(square, field_of(square, w / 4, field.angle), {w, 1, {}});
    REQUIRE(found);
    CHECK(self_intersections(found->curve) == 0);
    CHECK(segments_outside(found->curve, border) == 0);
    double length = 0;
    for (const Curve& loop : found->loops) length += loop.length();
    CHECK(found->curve.length() == Approx(length).epsilon(0.06));
    CHECK(length == Approx(16 * 16 / w).epsilon(0.1));
  }
}

TEST_CASE("on any island the curve leaves nothing bare, or the region is not for stripes") {
  std::size_t merged_ones = 0;
  for (std::uint64_t k = 0; k < 20; ++k) {
    Random random(100 + k);
    const Polygon island = random_island_of_kind(random, static_cast<int>(k % island_kinds), 5);
    const double start = random.uniform(0, 3), bend = random.uniform(-0.4, 0.4);
    const auto field = field_of(island, w / 4, [&](const Vec2& p) { return start + bend * p.norm(); });
    const auto found = stripe_curve(island, field, {w, k, {}});
    if (!found) continue;
    ++merged_ones;
    CAPTURE(k);
    CHECK(self_intersections(found->curve) == 0);
    CHECK(segments_outside(found->curve, BorderIndex(island, w)) == 0);
    CHECK(bare_area(found->curve, island, w) < 2 * w * w + 0.01 * area(island));
  }
  CHECK(merged_ones >= 8);
}

TEST_CASE("seeds move the joints of straight strands, and leave the strands") {
  const Polygon square = rectangle(16, 16);
  const DirectionField field = field_of(square, w / 4, [](const Vec2&) { return 0.0; });
  const auto one = stripe_curve(square, field, {w, 1, {}}), again = stripe_curve(square, field, {w, 1, {}}),
             other = stripe_curve(square, field, {w, 2, {}});
  REQUIRE((one && again && other));
  CHECK(one->curve.vertices == again->curve.vertices);
  CHECK(one->curve.vertices != other->curve.vertices);
  CHECK(mean_squared_angle(one->curve, field) ==
        Approx(mean_squared_angle(other->curve, field)).epsilon(0.05));
}

TEST_CASE("an empty field, and a region too large for the solver, are not for stripes") {
  const Polygon square = rectangle(10, 10);
  CHECK(!stripe_curve(square, {}, {w, 1, {}}));
  CHECK(!stripe_curve(square, field_of(square, 1, [](const Vec2&) { return 0.0; }), {0.01, 1, {}}));
}

TEST_CASE("the bare area counts thin places, which no disc of a bead width reaches") {
  const Polygon strip = rectangle(20, 0.6 * w);
  const Curve half{{{0.1, 0.1}, {10, 0.1}, {10, 0.2}, {0.1, 0.2}}};
  CHECK(bare_area(half, strip, w) == Approx(0.6 * w * (10 - 1.1 * w)).epsilon(0.03));
}
