// Islands for tests: some with names, some random.
#pragma once

#include <cmath>
#include <numbers>
#include <utility>

#include "core/geometry/region.hpp"
#include "core/model/part.hpp"
#include "core/numeric/random.hpp"

namespace unicursal::core::test {

inline Polygon rectangle(double width, double height) {
  return {{{0, 0}, {width, 0}, {width, height}, {0, height}}, {}};
}

inline Ring circle(const Vec2& center, double radius, int sides, bool counter_clockwise = true) {
  Ring ring;
  for (int k = 0; k < sides; ++k) {
    const double turn = (counter_clockwise ? 2 : -2) * std::numbers::pi * k / sides;
    ring.push_back(center + radius * Vec2(std::cos(turn), std::sin(turn)));
  }
  return ring;
}

/// A 12 × 12 mm square with a round hole of 3 mm radius.
inline Polygon square_with_hole() {
  Polygon polygon = rectangle(12, 12);
  polygon.holes.push_back(circle({6, 6}, 3, 40, false));
  return polygon;
}

/// The largest piece of a star-shaped outline with random bumps, from which up to `most_holes` discs are cut.
inline Polygon random_island(Random& random, double radius, int most_holes) {
  Ring outer;
  const int sides = 5 + static_cast<int>(random.below(60));
  const double roughness = random.uniform(0, 0.7);
  for (int k = 0; k < sides; ++k) {
    const double turn = 2 * std::numbers::pi * k / sides;
    const double r = radius * (1 - roughness * random.uniform());
    outer.push_back(r * Vec2(std::cos(turn), std::sin(turn)));
  }
  Region region = enclosed({outer}, FillRule::non_zero);
  const auto holes = static_cast<int>(random.below(static_cast<std::size_t>(most_holes) + 1));
  for (int k = 0; k < holes; ++k) {
    const double turn = random.uniform(0, 2 * std::numbers::pi), r = radius * random.uniform();
    const Vec2 center = r * Vec2(std::cos(turn), std::sin(turn));
    region = subtract(
        region,
        {{circle(center, radius * random.uniform(0.005, 0.2), 3 + static_cast<int>(random.below(30))), {}}});
  }
  Polygon largest = region.front();
  for (const Polygon& piece : region) {
    if (area(piece) > area(largest)) largest = piece;
  }
  return largest;
}

/// One zone over the whole outline.
inline Island whole(const Polygon& outline) {
  return {outline, {{0, {outline}}}};
}

inline std::vector<Zone> one_zone() {
  return {Zone{}};
}

}  // namespace unicursal::core::test
