#include "core/numeric/long_waves.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/numeric/quasi_newton.hpp"
#include "core/numeric/random.hpp"

namespace unicursal::core {
namespace {

std::vector<Vec2> random_points(std::size_t count, double size, Random& random) {
  std::vector<Vec2> points;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = random.uniform(0, size);
    points.push_back({x, random.uniform(0, size)});
  }
  return points;
}

double hat(double x) {
  return std::max(0.0, 1 - std::abs(x));
}

/// Σ P Pᵀ field written out: the grids' hats at every two points.
std::vector<Vec2> by_definition(const std::vector<Vec2>& points, const std::vector<Vec2>& field,
                                double finest, double strength) {
  Vec2 low = points.front(), high = points.front();
  for (const Vec2& p : points) low = low.cwiseMin(p), high = high.cwiseMax(p);
  std::vector<Vec2> result = field;
  double nodes = std::floor((high - low).maxCoeff() / finest) + 2;
  for (double mesh = finest;; mesh *= 2, nodes = std::floor(nodes / 2) + 1) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      for (std::size_t j = 0; j < points.size(); ++j) {
        double overlap[2] = {0, 0};
        for (int axis = 0; axis < 2; ++axis) {
          const double a = (points[i] - low)[axis] / mesh, b = (points[j] - low)[axis] / mesh;
          for (int k = 0; k < 40; ++k) overlap[axis] += hat(a - k) * hat(b - k);
        }
        result[i] += strength * overlap[0] * overlap[1] * field[j];
      }
    }
    if (nodes <= 3) return result;
  }
}

TEST_CASE("long waves add the sums over the hat functions of all grids") {
  Random random(3);
  const std::vector<Vec2> points = random_points(40, 30, random);
  const std::vector<Vec2> field = random_points(40, 2, random);
  std::vector<Vec2> waved = field;
  LongWaves(points, 1.7, 0.3).apply(waved);
  const std::vector<Vec2> expected = by_definition(points, field, 1.7, 0.3);
  for (std::size_t i = 0; i < points.size(); ++i) {
    INFO(i);
    CHECK((waved[i] - expected[i]).norm() < 1e-5 * expected[i].norm());
  }
}

TEST_CASE("long waves are symmetric and positive, and do not depend on threads") {
  Random random(4);
  const std::vector<Vec2> points = random_points(9000, 100, random);
  const std::vector<Vec2> a = random_points(9000, 1, random), b = random_points(9000, 1, random);
  const LongWaves waves(points, 2, 0.1);
  std::vector<Vec2> wa = a, wb = b, shared = a;
  waves.apply(wa);
  waves.apply(wb);
  Workers workers(2);
  waves.apply(shared, &workers);
  CHECK(dot(wa, b) == Approx(dot(a, wb)));
  CHECK(dot(wa, a) > dot(a, a));
  CHECK(wa == shared);
}

/// Σ (x_{i+1} − x_i − 1)² of a chain with its ends held: short waves settle at once, long ones slowly.
int steps_to_settle(double strength) {
  const std::size_t count = 400;
  std::vector<Vec2> x;
  for (std::size_t i = 0; i < count; ++i) {
    const double t = static_cast<double>(i);
    x.push_back({t + 20 * std::min(t / 100, (399 - t) / 299), 0});
  }
  QuasiNewton newton;
  newton.forget(strength > 0 ? LongWaves(x, 4, strength) : LongWaves());
  const auto gradient_at = [&](const std::vector<Vec2>& at) {
    std::vector<Vec2> gradient(count, Vec2(0, 0));
    for (std::size_t i = 0; i + 1 < count; ++i) {
      const double pull = 2 * (at[i + 1].x() - at[i].x() - 1);
      gradient[i + 1].x() += pull, gradient[i].x() -= pull;
    }
    gradient.front() = gradient.back() = Vec2(0, 0);
    return gradient;
  };
  std::vector<Vec2> gradient = gradient_at(x);
  for (int step = 1; step < 1000; ++step) {
    std::vector<Vec2> direction = newton.direction(gradient);
    direction.front() = direction.back() = Vec2(0, 0);
    // The best length of a step is known for a quadratic.
    std::vector<Vec2> ahead = x;
    add_scaled(ahead, 1, direction);
    std::vector<Vec2> change = gradient_at(ahead);
    add_scaled(change, -1, gradient);
    const double length = -dot(gradient, direction) / dot(change, direction);
    add_scaled(x, length, direction);
    for (Vec2& v : direction) v *= length;
    for (Vec2& v : change) v *= length;
    newton.remember(direction, change);
    gradient = gradient_at(x);
    double farthest = 0;
    for (std::size_t i = 0; i < count; ++i)
      farthest = std::max(farthest, std::abs(x[i].x() - static_cast<double>(i)));
    if (farthest < 0.1) return step;
  }
  return 1000;
}

TEST_CASE("long waves let a long chain settle in a fraction of the steps") {
  const int without = steps_to_settle(0), with = steps_to_settle(0.3);
  INFO(without << " steps without, " << with << " with");
  CHECK(3 * with < without);
}

}  // namespace
}  // namespace unicursal::core
