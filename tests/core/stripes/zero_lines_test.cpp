#include "core/stripes/zero_lines.hpp"

#include <catch2/catch.hpp>

#include "core/curve/clearance.hpp"
#include "tests/core/support/fields.hpp"
#include "tests/core/support/phases.hpp"
#include "tests/core/support/random_islands.hpp"

using namespace unicursal::core;
using namespace unicursal::core::test;

namespace {

std::vector<Curve> loops_of(const Polygon& region, const DirectionField& field, double w) {
  return zero_lines(phase_of(region, field, w), region, BorderIndex(region, w), w);
}

}  // namespace

TEST_CASE("zero lines are simple, lie inside, and have the negative values on their left") {
  const double w = 0.5;
  for (std::uint64_t k = 0; k < 14; ++k) {
    Random random(k);
    const Polygon island = random_island(random, 6, 4);
    const double bend = random.uniform(-0.5, 0.5), start = random.uniform(0, 3);
    const DirectionField field =
        field_of(island, w / 4, [&](const Vec2& p) { return start + bend * p.x() + std::sin(bend * p.y()); });
    const BorderIndex border(island, w);
    const Phase phase = phase_of(island, field, w);
    const std::vector<Curve> loops = zero_lines(phase, island, border, w);
    CAPTURE(k, loops.size());
    REQUIRE(!loops.empty());
    for (const Curve& loop : loops) {
      CHECK(self_intersections(loop) == 0);
      CHECK(segments_outside(loop, border) == 0);
      std::size_t checked = 0, right = 0;
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const Vec2 &a = loop.vertices[i], &b = loop.vertices[loop.after(i)];
        const Vec2 left = (a + b) / 2 + 0.1 * w * perpendicular(b - a).normalized();
        if (border.distance(left, left, w) < 0.97 * w) continue;  // thin places, raised values
        ++checked;
        right += phase.cosine(left) < 0;
      }
      CHECK(right + checked / 20 >= checked);
    }
  }
}

TEST_CASE("a strip narrower than two beads gets one loop there and back, whatever its directions") {
  const double w = 0.5;
  const double width = GENERATE(0.6, 0.75, 0.9);
  const double angle = GENERATE(0.0, 0.8, 1.57);
  const Polygon strip = rectangle(12, width);
  const auto loops = loops_of(strip, field_of(strip, w / 4, [&](const Vec2&) { return angle; }), w);
  REQUIRE(loops.size() == 1);
  CHECK(loops.front().length() > 2 * (12 - 2 * w));
}
