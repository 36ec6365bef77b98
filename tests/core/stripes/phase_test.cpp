#include "core/stripes/phase.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "core/stripes/zero_lines.hpp"
#include "tests/core/support/fields.hpp"
#include "tests/core/support/phases.hpp"
#include "tests/core/support/shapes.hpp"

using namespace unicursal::core;
using namespace unicursal::core::test;

namespace {

constexpr double pi = std::numbers::pi;

}  // namespace

TEST_CASE("in a field of one direction the phase grows by half a turn a bead width, across the strands") {
  // With the larger width all nodes are solved for at once, with the smaller one on three levels.
  const double w = GENERATE(0.6, 0.2);
  const double angle = GENERATE(0.3, 1.1, 2.4);
  const Vec2 along(std::cos(angle), std::sin(angle)), across(-std::sin(angle), std::cos(angle));
  const Vec2 corner = Vec2(20, 20);
  const double height = 12 * w;
  const Polygon plate{
      {corner, corner + 15 * along, corner + 15 * along + height * across, corner + height * across}, {}};
  const Phase phase = phase_of(plate, field_of(plate, w / 4, [&](const Vec2&) { return angle; }), w);
  double worst = 0;
  for (double x = 1; x < 14; x += 0.37) {
    for (double y = 0.1 * w; y < height - 0.1 * w; y += 0.13 * w) {
      const double cosine = phase.cosine(corner + x * along + y * across);
      worst = std::max(worst, std::abs(cosine - std::cos(pi * y / w)));
    }
  }
  CHECK(worst < 0.1);
}

TEST_CASE("strands along a border lie half a bead width inside it, and all others in rows") {
  const double w = GENERATE(0.6, 0.2);
  const Polygon square = rectangle(12, 12);
  const BorderIndex border(square, w);
  const Phase phase = phase_of(square, field_of(square, w / 4, [](const Vec2&) { return 0.0; }), w);
  const std::vector<Curve> loops = zero_lines(phase, square, border, w);
  CHECK(static_cast<long>(loops.size()) == std::lround(12 / (2 * w)));
  double worst = 0;
  for (const Curve& loop : loops) {
    for (const Vec2& v : loop.vertices) {
      if (v.x() < 2 * w || v.x() > 12 - 2 * w) continue;
      worst = std::max(worst, std::abs(std::remainder(v.y() - w / 2, w)));
    }
  }
  CHECK(worst < 0.03 * w);
}

TEST_CASE("a height that holds no even number of strands stretches them all alike") {
  const double w = 0.6;
  const Polygon plate = rectangle(12, 11.6);  // 19.33 strands: 20 of 0.58 mm or 18 of 0.644 mm
  const BorderIndex border(plate, w);
  const Phase phase = phase_of(plate, field_of(plate, w / 4, [](const Vec2&) { return 0.0; }), w);
  for (const double x : {3.0, 5.0, 6.0, 8.0}) {
    std::vector<double> heights;
    for (double y = 0.01; y < 11.59; y += 0.01) {
      if (phase.cosine({x, y}) * phase.cosine({x, y + 0.01}) <= 0) heights.push_back(y);
    }
    REQUIRE(heights.size() == 20);
    for (std::size_t k = 1; k < heights.size(); ++k)
      CHECK(heights[k] - heights[k - 1] == Approx(0.58).margin(0.05));
  }
}

TEST_CASE("rings around the middle of a disc are rings") {
  const double w = 0.5;
  const Polygon disc{circle({8, 8}, 7, 200), {}};  // 14 strands: seven loops of two
  const BorderIndex border(disc, w);
  const DirectionField around =
      field_of(disc, w / 4, [](const Vec2& p) { return std::atan2(p.y() - 8, p.x() - 8) + pi / 2; });
  const std::vector<Curve> loops = zero_lines(phase_of(disc, around, w), disc, border, w);
  int rings = 0;
  for (const Curve& loop : loops) {
    double least = 100, most = 0;
    for (const Vec2& v : loop.vertices) {
      least = std::min(least, (v - Vec2(8, 8)).norm());
      most = std::max(most, (v - Vec2(8, 8)).norm());
    }
    if (most - least > 0.2 * w) continue;
    ++rings;
    CHECK(std::abs(std::remainder((least + most) / 2 - 6.75, w)) < 0.1 * w);
  }
  CHECK(rings >= 11);  // those in the middle are less than round
}

TEST_CASE("around half a singularity, where a direction comes back as its opposite, strands stay apart") {
  const double w = 0.5;
  const double turns = GENERATE(0.5, -0.5);
  const Polygon square = rectangle(14, 14);
  const DirectionField field =
      field_of(square, w / 4, [&](const Vec2& p) { return turns * std::atan2(p.y() - 7, p.x() - 7) + 0.2; });
  const Phase phase = phase_of(square, field, w);
  // On the way around the middle the field passes every direction, and the cosine is continuous.
  double before = phase.cosine({12, 7}), jump = 0;
  for (int k = 1; k <= 4000; ++k) {
    const double turn = 2 * pi * k / 4000;
    const double here = phase.cosine(Vec2(7, 7) + 5 * Vec2(std::cos(turn), std::sin(turn)));
    jump = std::max(jump, std::abs(here - before));
    before = here;
  }
  // 0.008 mm are 0.05 rad of phase.
  CHECK(jump < 0.15);
}
