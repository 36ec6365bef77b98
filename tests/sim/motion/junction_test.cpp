#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

#include "sim/motion/junction.hpp"

using namespace unicursal::sim;

namespace {

constexpr PerAxis<double> jerk{10, 10, 0.3, 5};
constexpr PerAxis<double> fast_axes{1500, 1500, 100, 10000};

MoveShape heading(double degrees, double nominal = 100, double length = 5) {
  const double angle = degrees * std::numbers::pi / 180;
  return {{std::cos(angle), std::sin(angle), 0, 0}, nominal, length};
}

}  // namespace

TEST_CASE("classic jerk: a straight line costs no speed") {
  CHECK(jerk_speed(heading(30), heading(30), jerk) == Approx(100));
}

TEST_CASE("classic jerk: the axis with the greatest change limits a corner") {
  CHECK(jerk_speed(heading(0), heading(90), jerk) == Approx(10));
  // x goes from 1 to cos 30°, y from 0 to sin 30° = ½: y has the greater jump.
  CHECK(jerk_speed(heading(0), heading(30), jerk) == Approx(20));
}

TEST_CASE("classic jerk: an axis that reverses jumps by its greater speed, not by the sum") {
  CHECK(jerk_speed(heading(0), heading(180), jerk) == Approx(10));
}

TEST_CASE("classic jerk: slow moves need no braking at all") {
  CHECK(jerk_speed(heading(0, 8), heading(180, 9), jerk) == Approx(8));
}

TEST_CASE("junction deviation: the corner is an arc with that deviation") {
  const double deviation = 0.013, acceleration = 1000;
  const double turn = GENERATE(20.0, 60.0, 90.0, 140.0);
  // An arc tangent to both moves deviates from the corner by r·(1/cos(turn/2) − 1); its speed is √(a·r).
  const double radius = deviation / (1 / std::cos(turn / 2 * std::numbers::pi / 180) - 1);
  const double limit = std::min(acceleration, 1500.0);
  CHECK(deviation_speed(heading(0), heading(turn), deviation, fast_axes, limit) ==
        Approx(std::min(100.0, std::sqrt(limit * radius))).epsilon(1e-6));
}

TEST_CASE("junction deviation: a straight line costs no speed, a reversal is a stop") {
  CHECK(deviation_speed(heading(10), heading(10), 0.013, fast_axes, 1000) == Approx(100));
  CHECK(deviation_speed(heading(10), heading(190), 0.013, fast_axes, 1000) == 0);
}

TEST_CASE("junction deviation: a circle of many short moves has the speed that its radius allows") {
  const double radius = 2, angle = 5;  // mm, degrees per move
  const double length = 2 * radius * std::sin(angle / 2 * std::numbers::pi / 180);
  const double speed =
      deviation_speed(heading(0, 100, length), heading(angle, 100, length), 0.05, fast_axes, 1000);
  CHECK(speed == Approx(std::sqrt(1000 * radius)).epsilon(0.01));
}
