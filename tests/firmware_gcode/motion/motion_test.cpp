#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>

#include "firmware_gcode/motion/time_estimate.hpp"

using namespace unicursal::gcode;

namespace {

/// Axes without limits, so that only the tested rule counts.
Printer free_printer() {
  Printer printer;
  printer.max_speed = {1000, 1000, 1000};
  printer.max_acceleration = {1e6, 1e6, 1e6};
  printer.motion.acceleration = printer.motion.travel_acceleration = 1000;
  return printer;
}

Course course(double x, double y, double speed) {
  const double length = std::hypot(x, y);
  return {{x / length, y / length, 0, 0}, length, speed, 1000};
}

double seconds_of(const Printer& printer, const std::vector<PerAxis>& moves, double speed) {
  TimeEstimate estimate(printer);
  for (const PerAxis& move : moves) estimate.move(move, speed);
  return estimate.seconds();
}

}  // namespace

TEST_CASE("one move: up from its jerk, along, and down to standstill") {
  // 10 mm/s at once, 1000 mm/s² up to 50, down to 0.05
  const double up = 40 / 1000.0, down = 49.95 / 1000;
  const double ramps = (50 * 50 - 10 * 10) / 2000.0 + (50 * 50 - 0.05 * 0.05) / 2000;
  CHECK(seconds_of(free_printer(), {{100, 0, 0, 0}}, 50) == Approx(up + down + (100 - ramps) / 50));
  // Too short for 50 mm/s: v² = (10² + 0.05²) / 2 + 1000 · 1
  const double top = std::sqrt((100 + 0.0025) / 2 + 1000);
  CHECK(seconds_of(free_printer(), {{1, 0, 0, 0}}, 50) == Approx((2 * top - 10 - 0.05) / 1000));
}

TEST_CASE("a straight line takes as long in pieces as in one move") {
  const std::vector<PerAxis> pieces(400, PerAxis{0.2, 0.15, 0, 0.01});
  const Printer printer = free_printer();
  CHECK(seconds_of(printer, pieces, 40) == Approx(seconds_of(printer, {{80, 60, 0, 4}}, 40)).epsilon(1e-3));
}

TEST_CASE("pieces too short for braking within the planned moves run slower") {
  // 14 pieces of 0.01 mm: 0.13 mm to brake in, from no more than √(2 · 1000 · 0.14)
  const std::vector<PerAxis> pieces(20000, PerAxis{0.01, 0, 0, 0});
  const double seconds = seconds_of(free_printer(), pieces, 100);
  CHECK(seconds > 200 / std::sqrt(2 * 1000 * 0.14));
  CHECK(seconds < 200 / std::sqrt(2 * 1000 * 0.12));
}

TEST_CASE("corners by jerk: no axis jumps by more than its jerk") {
  const Printer printer = free_printer();  // 10 mm/s in x and y
  CHECK(junction_speed(course(1, 0, 50), course(0, 1, 50), printer) == Approx(10));
  CHECK(junction_speed(course(1, 0, 50), course(-1, 0, 50), printer) == Approx(10));
  CHECK(junction_speed(course(1, 0, 50), course(1, 0, 30), printer) == Approx(30));
  // 1 mm/s turned by 30° makes y jump by sin 30°
  const double thirty = std::numbers::pi / 6;
  CHECK(junction_speed(course(1, 0, 50), course(std::cos(thirty), std::sin(thirty), 50), printer) ==
        Approx(20));
}

TEST_CASE("corners by deviation: an arc that deviates by the given distance") {
  Printer printer = free_printer();
  printer.motion.junction_deviation = 0.02;
  // v² = a · r, and the arc's sagitta at the corner is r · (1 / cos(turn/2) - 1)
  for (const double turn : {0.9, std::numbers::pi / 2, 2.5}) {
    const double radius = 0.02 / (1 / std::cos(turn / 2) - 1);
    CHECK(junction_speed(course(5, 0, 500), course(5 * std::cos(turn), 5 * std::sin(turn), 500), printer) ==
          Approx(std::sqrt(1000 * radius)));
  }
  CHECK(junction_speed(course(5, 0, 50), course(-5, 0, 50), printer) < 0.1);
  // Short chords of an arc: v² = a · chord ÷ turn
  CHECK(junction_speed(course(0.1, 0, 500), course(0.1 * std::cos(0.2), 0.1 * std::sin(0.2), 500), printer) ==
        Approx(std::sqrt(1000 * 0.1 / 0.2)));
}

TEST_CASE("axes limit speed and acceleration, the extruder's too") {
  Printer printer = free_printer();
  printer.max_speed = {30, 1000, 5};
  CHECK(seconds_of(printer, {{3000, 4000, 0, 0}}, 500) == Approx(5000 / 50.0).epsilon(1e-3));
  CHECK(seconds_of(printer, {{0, 0, 500, 0}}, 500) == Approx(100).epsilon(1e-3));
  printer.motion.extruder_speed = 2;
  CHECK(seconds_of(printer, {{0, 1000, 0, 100}}, 500) == Approx(50).epsilon(1e-2));
  CHECK(seconds_of(printer, {{0, 0, 0, -10}}, 25) == Approx(5).epsilon(1e-2));
}

TEST_CASE("the watch receives every move once, in order, and all seconds") {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> steps(-2, 2);
  double heard = 0, next = 0;
  bool in_order = true;
  TimeEstimate estimate(free_printer(), [&](double seconds, double load) {
    in_order = in_order && load == next++;
    heard += seconds;
  });
  double before = 0;
  for (int i = 0; i < 500; ++i) {
    estimate.move({steps(random), steps(random), 0, 0.01}, 60, i);
    if (i % 100 == 50) estimate.stop();
    CHECK(estimate.seconds() > before);
    before = estimate.seconds();
  }
  estimate.stop();
  CHECK(in_order);
  CHECK(next == 500);
  CHECK(heard == Approx(estimate.seconds()));
  CHECK(before == Approx(heard));
}
