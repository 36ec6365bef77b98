// Shapes of thin walls: frames, crosses, ladders, combs, tubes, wedges. mm.
#pragma once

#include <cmath>
#include <numbers>

#include "core/geometry/region.hpp"
#include "tests/core/support/shapes.hpp"

namespace unicursal::core::test {

inline Polygon box(const Vec2& low, const Vec2& high) {
  return {{{low.x(), low.y()}, {high.x(), low.y()}, {high.x(), high.y()}, {low.x(), high.y()}}, {}};
}

inline Polygon frame(double wall) {
  return subtract({rectangle(25, 15)}, {box({wall, wall}, {25 - wall, 15 - wall})}).front();
}

inline Polygon cross_of_bars(double wall) {
  const double a = (20 - wall) / 2, b = (20 + wall) / 2;
  return unite({box({a, 0}, {b, 20})}, {box({0, a}, {20, b})}).front();
}

inline Polygon ladder(double wall) {
  Region holes;
  for (int k = 0; k < 4; ++k) holes.push_back(box({wall + 8 * k, wall}, {8 * (k + 1), 18 - wall}));
  return subtract({rectangle(32 + wall, 18)}, holes).front();
}

inline Polygon comb_of_teeth(double wall) {
  Region teeth{rectangle(32, 5)};
  for (int k = 0; k < 4; ++k) teeth = unite(teeth, {box({1.0 + 8 * k, 4}, {1.0 + 8 * k + wall, 16})});
  return teeth.front();
}

inline Polygon tube(double radius, double wall) {
  return {circle({0, 0}, radius, 120), {circle({0, 0}, radius - wall, 120, false)}};
}

/// Its tip is at the origin.
inline Polygon wedge(double end) {
  return {{{40, -end / 2}, {40, end / 2}, {0, 0}}, {}};
}

/// The polygon turned about the origin.
inline Polygon turned(Polygon polygon, double degrees) {
  const double turn = degrees / 180 * std::numbers::pi, c = std::cos(turn), s = std::sin(turn);
  const auto turn_ring = [&](Ring& ring) {
    for (Vec2& v : ring) v = Vec2(c * v.x() - s * v.y(), s * v.x() + c * v.y());
  };
  turn_ring(polygon.outer);
  for (Ring& hole : polygon.holes) turn_ring(hole);
  return polygon;
}

}  // namespace unicursal::core::test
