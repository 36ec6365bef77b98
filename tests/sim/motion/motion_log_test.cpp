#include <catch2/catch.hpp>

#include <numeric>

#include "sim/motion/motion_log.hpp"
#include "sim/motion/move_sinks.hpp"

using namespace unicursal::sim;

namespace {

constexpr double filament_area = 2.4;
constexpr Mix mix{0, {32768}};

/// A bead of `length` along x at constant speed.
ExecutedMove even(double from_x, double length, double speed, double filament, double start) {
  ExecutedMove move;
  move.from = {from_x, 0, 0.2};
  move.to = {from_x + length, 0, 0.2};
  move.filament = filament;
  move.mix = mix;
  move.start = start;
  move.end = start + length / speed;
  move.speed = {length, speed, speed, speed, 1000};
  return move;
}

double sum(const std::map<double, double>& seconds) {
  double total = 0;
  for (const auto& [flow, time] : seconds) total += time;
  return total;
}

}  // namespace

TEST_CASE("the flow of a move at constant speed lies in one bin, with all its time") {
  MotionLog log(filament_area);
  log.moved(even(0, 30, 20, 1, 5));
  const double flow = filament_area / 1.5;
  REQUIRE(log.flows().size() == 1);
  CHECK(log.flows().begin()->first == Approx(flow).epsilon(0.004));
  CHECK(log.flows().begin()->second == Approx(1.5));
  REQUIRE(log.second_flows().size() == 1);
  CHECK(log.second_flows().begin()->second == Approx(1));
  CHECK(log.mean_speed() == Approx(20));
}

TEST_CASE("the flow of a ramp is spread over its speeds") {
  MotionLog log(filament_area);
  ExecutedMove move = even(0, 30, 20, 1, 0);
  move.speed = {30, 0.05, 20, 0.05, 100};
  move.end = move.speed.seconds();
  log.moved(move);
  double volume = 0;
  for (const auto& [flow, seconds] : log.flows()) volume += flow * seconds;
  CHECK(volume == Approx(filament_area).epsilon(0.005));
  CHECK(sum(log.flows()) == Approx(move.end));
  CHECK(log.flows().rbegin()->first == Approx(filament_area / 30 * 20).epsilon(0.004));
  CHECK(log.flows().begin()->first < filament_area / 30 * 2);
}

TEST_CASE("spans cover a print of any length, and keep its sums") {
  MotionLog log(filament_area);
  double time = 100;
  for (int i = 0; i < 3000; ++i) {
    log.queue_changed(time, static_cast<std::size_t>(i % 16));
    log.moved(even(i, 50, 20, 1, time));
    time += 2.5 + (i % 7 == 0 ? 1 : 0);
  }
  log.queue_changed(time, 0);
  CHECK(log.spans().size() <= 4096);
  CHECK(static_cast<double>(log.spans().size()) * log.span_seconds() >= time - 100);
  double seconds = 0, volume = 0, observed = 0, length = 0;
  for (const MotionSpan& span : log.spans()) {
    seconds += span.seconds;
    volume += span.volume;
    observed += span.observed;
    length += span.length;
    CHECK(span.seconds <= log.span_seconds() * (1 + 1e-9));
    CHECK(span.mean_fill() <= 15);
  }
  CHECK(seconds == Approx(7500));
  CHECK(length == Approx(150000));
  CHECK(volume == Approx(3000 * filament_area));
  CHECK(observed == Approx(time - 100));
  CHECK(std::accumulate(log.fill().begin(), log.fill().end(), 0.0) == Approx(time - 100));
}

TEST_CASE("starvations are counted, and the positions of the first ones are kept") {
  MotionLog log(filament_area);
  for (int i = 0; i < 150; ++i) log.starved({double(i), {1, 2, 3}, i % 3 == 0 ? 0.5 : 0, i % 3 == 0});
  CHECK(log.dry() == 50);
  CHECK(log.hasty() == 100);
  CHECK(log.dry_seconds() == Approx(25));
  CHECK(log.starvations().size() == 100);
}
