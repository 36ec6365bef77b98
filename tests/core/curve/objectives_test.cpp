// Compares every gradient with central differences.
#include <catch2/catch.hpp>

#include <functional>

#include "core/curve/coverage.hpp"
#include "core/curve/shape_terms.hpp"
#include "core/geometry/segment_diagram.hpp"
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

TEST_CASE("the gradient of the coverage agrees with differences of its value on the lattice") {
  Random random(3);
  const Lattice lattice = sample(rectangle(10, 10), 0.11);
  Coverage coverage(lattice);
  const Objective cover = [&](const Curve& c, std::vector<Vec2>& g) { return coverage.evaluate(c, 1, g); };
  // Owners are found in single precision; the value is summed in double precision.
  CHECK(worst_error(cover, wavy(random), random, 1e-4) < 2e-3);
}

TEST_CASE("coverage of a straight strand in a strip is the second moment of its width") {
  // A long thin loop in the middle of a 40 × 1 strip whose ends touch the borders: ∫ y² = length · w³/12.
  const Lattice lattice = sample(rectangle(40, 1), 0.02);
  Coverage coverage(lattice);
  const Curve strand{{{0, 0.5}, {20, 0.5}, {40, 0.5}, {20, 0.5}}};
  std::vector<Vec2> gradient(4, Vec2(0, 0));
  CHECK(coverage.evaluate(strand, 1, gradient) == Approx(40.0 / 12).epsilon(1e-3));
}

TEST_CASE("with split squares a coarse lattice is within 0.5 % of the exact diagram") {
  // Folds with spacings of about 1, five squares each; borders between folds cut the squares anywhere.
  Curve folds;
  for (int k = 0; k < 12; ++k) {
    for (int i = 0; i <= 100; ++i) {
      const double up = (k == 0 ? 0.5 : 1.5) + i / 100.0 * (k == 0 ? 59.0 : 58.0);
      folds.vertices.emplace_back(k + 0.5 + 0.1 * std::sin(2 * k), k % 2 == 0 ? up : 61.0 - up);
    }
  }
  for (int i = 1; i < 22; ++i) folds.vertices.emplace_back(11.5 - i * 0.5, 0.5);
  const Polygon island = rectangle(12, 60);
  double exact = 0;
  const SegmentDiagram diagram = segment_diagram(folds.vertices, island);
  for (const auto* cells : {&diagram.points, &diagram.segments}) {
    for (const CellIntegrals& cell : *cells) exact += cell.second_moment;
  }
  const Lattice lattice = sample(island, 0.2);
  Coverage coverage(lattice);
  std::vector<Vec2> gradient(folds.size(), Vec2(0, 0));
  const double value = coverage.evaluate(folds, 1, gradient);
  // The second moment of the squares about their centres, which point samples do not include.
  const double within = area(island) * 0.2 * 0.2 / 12;
  INFO("exact " << exact << ", sampled " << value << ", within squares " << within);
  CHECK(value + within == Approx(exact).epsilon(0.005));
}

TEST_CASE("smoothness of a regular polygon has its closed form") {
  const Curve square{{{0, 0}, {2, 0}, {2, 2}, {0, 2}}};
  CHECK(smoothness(square) == Approx(4 * 2.0));  // each vertex is √2 from the middle of its neighbours
}
