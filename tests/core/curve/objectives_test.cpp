// Every gradient against central differences.
#include <catch2/catch.hpp>

#include <functional>

#include "core/curve/coverage.hpp"
#include "core/curve/shape_terms.hpp"
#include "tests/core/support/shapes.hpp"

using namespace unicursal::core;
using namespace unicursal::core::test;

namespace {

Curve wavy(Random& random) {
  Curve curve;
  for (int k = 0; k < 60; ++k) {
    const double turn = 2 * std::numbers::pi * k / 60, r = 3 + std::sin(5 * turn) + 0.1 * random.uniform();
    curve.vertices.push_back(Vec2(5, 5) + r * Vec2(std::cos(turn), std::sin(turn)));
  }
  return curve;
}

using Objective = std::function<double(const Curve&, std::vector<Vec2>&)>;

/// Directional derivatives along random moves of all vertices; returns the largest relative error.
double worst_error(const Objective& objective, Curve curve, Random& random, double h) {
  double worst = 0;
  for (int trial = 0; trial < 20; ++trial) {
    std::vector<Vec2> gradient(curve.size(), Vec2(0, 0)), ignored = gradient, way = gradient;
    objective(curve, gradient);
    double slope = 0, scale = 0;
    Curve ahead = curve, behind = curve;
    for (std::size_t i = 0; i < curve.size(); ++i) {
      way[i] = Vec2(random.uniform(-1, 1), random.uniform(-1, 1));
      slope += gradient[i].dot(way[i]);
      scale += gradient[i].norm() * way[i].norm();
      ahead.vertices[i] += h * way[i];
      behind.vertices[i] -= h * way[i];
    }
    const double difference = (objective(ahead, ignored) - objective(behind, ignored)) / (2 * h);
    worst = std::max(worst, std::abs(difference - slope) / scale);
  }
  return worst;
}

}  // namespace

TEST_CASE("the gradient of the length is exact") {
  Random random(1);
  const Objective length = [](const Curve& c, std::vector<Vec2>& g) { return length_with_gradient(c, 1, g); };
  CHECK(worst_error(length, wavy(random), random, 1e-5) < 1e-8);
}

TEST_CASE("the gradient of the smoothness is exact") {
  Random random(2);
  const Objective smooth = [](const Curve& c, std::vector<Vec2>& g) {
    return smoothness_with_gradient(c, 1, g);
  };
  CHECK(worst_error(smooth, wavy(random), random, 1e-4) < 1e-8);
}

TEST_CASE("the gradient of the coverage is that of the lattice") {
  Random random(3);
  const Lattice lattice = sample(rectangle(10, 10), 0.11);
  Coverage coverage(lattice);
  const Objective cover = [&](const Curve& c, std::vector<Vec2>& g) { return coverage.evaluate(c, 1, g); };
  // Owners are found in float precision; the value is summed in double.
  CHECK(worst_error(cover, wavy(random), random, 1e-4) < 2e-3);
}

TEST_CASE("coverage of a straight strand in a strip is the second moment of its width") {
  // A long thin loop in the middle of a 40 × 1 strip, ends at the borders: ∫ y² = length · w³/12.
  const Lattice lattice = sample(rectangle(40, 1), 0.02);
  Coverage coverage(lattice);
  const Curve strand{{{0, 0.5}, {20, 0.5}, {40, 0.5}, {20, 0.5}}};
  std::vector<Vec2> gradient(4, Vec2(0, 0));
  CHECK(coverage.evaluate(strand, 1, gradient) == Approx(40.0 / 12).epsilon(1e-3));
}

TEST_CASE("smoothness of a regular polygon has its closed form") {
  const Curve square{{{0, 0}, {2, 0}, {2, 2}, {0, 2}}};
  CHECK(smoothness(square) == Approx(4 * 2.0));  // each vertex is √2 from the middle of its neighbours
}
