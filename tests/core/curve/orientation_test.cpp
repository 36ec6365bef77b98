#include "core/curve/orientation.hpp"

#include <catch2/catch.hpp>

#include <numbers>

#include "core/curve/evenness.hpp"
#include "core/numeric/random.hpp"

using namespace unicursal::core;

namespace {

constexpr double pi = std::numbers::pi;

Curve wiggle(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  Curve curve;
  for (std::size_t i = 0; i < n; ++i) {
    const double a = 2 * pi * static_cast<double>(i) / static_cast<double>(n);
    curve.vertices.push_back((5 + random.uniform()) * Vec2(std::cos(a), 0.6 * std::sin(a)));
  }
  return curve;
}

}  // namespace

TEST_CASE("the distance is π²/12 for parallel lines of any direction, and 0 for uniform directions") {
  for (const double angle : {0.0, 0.4, 1.5, 3.1, -2.0}) {
    CHECK(isotropy_distance({{angle, 1}, {angle, 5}, {angle + pi, 0.3}}) == Approx(pi * pi / 12));
  }
  std::vector<Stroke> even;
  for (int k = 0; k < 1000; ++k) even.push_back({pi * k / 1000.0, 2});
  CHECK(isotropy_distance(even) == Approx(0).margin(1e-6));
  CHECK(isotropy_distance({}) == 0);
}

TEST_CASE("the distance of k equally spaced directions of equal length is π²/12k²") {
  for (const int k : {1, 2, 3, 7}) {
    std::vector<Stroke> strokes;
    for (int i = 0; i < k; ++i) strokes.push_back({0.2 + pi * i / k, 1});
    CHECK(isotropy_distance(strokes) == Approx(pi * pi / 12 / (k * k)));
  }
}

TEST_CASE("a rotation of all strokes does not change the distance") {
  Random random(3);
  std::vector<Stroke> strokes;
  for (int k = 0; k < 40; ++k) strokes.push_back({random.uniform(0, pi), random.uniform()});
  const double at_rest = isotropy_distance(strokes);
  for (Stroke& s : strokes) s.angle += 1.234;
  CHECK(isotropy_distance(strokes) == Approx(at_rest));
}

TEST_CASE("the gradient of the transport is exact") {
  const Curve curve = wiggle(60, 4);
  std::vector<char> counts(curve.size(), 1);
  for (std::size_t i = 10; i < 25; ++i) counts[i] = 0;
  std::vector<Vec2> gradient(curve.size(), Vec2(0, 0)), ignored = gradient;
  isotropy_with_gradient(curve, counts, 3, gradient);
  Random random(6);
  for (int trial = 0; trial < 300; ++trial) {
    const std::size_t i = random.below(curve.size());
    const Vec2 way(random.uniform(-1, 1), random.uniform(-1, 1));
    const double h = 1e-6;
    Curve ahead = curve, behind = curve;
    ahead.vertices[i] += h * way;
    behind.vertices[i] -= h * way;
    const double slope = (isotropy_with_gradient(ahead, counts, 0, ignored) -
                          isotropy_with_gradient(behind, counts, 0, ignored)) /
                         (2 * h);
    REQUIRE(gradient[i].dot(way) == Approx(3 * slope).margin(1e-7).epsilon(1e-5));
  }
}

TEST_CASE("the variation of widths is measured over windows along the path") {
  // Four sides of 1 mm with areas 1, 3, 1, 3: windows of one side have widths 1 and 3, of two sides always 2.
  BeadPath path;
  path.beads = {{{0, 0}, 1, 0}, {{1, 0}, 3, 0}, {{1, 1}, 1, 0}, {{0, 1}, 3, 0}};
  CHECK(width_variation(path, 1) == Approx(0.5));
  CHECK(width_variation(path, 2) == Approx(0).margin(1e-9));
  CHECK(width_variation(path, 5) == 0);
}
