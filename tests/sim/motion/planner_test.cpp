#include <catch2/catch.hpp>

#include <cmath>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

#include "../bench.hpp"

using namespace unicursal::sim;

namespace {

constexpr Mix half_half{0, {32768, 32768, 0}};
constexpr double start_delay = 0.1;  // s that a first block waits
constexpr double end_speed = 0.05;   // mm/s at the end of the queue

PerAxis<std::int64_t> at(double x, double y = 0, double z = 0, double e = 0) {
  return {std::llround(x * 80), std::llround(y * 80), std::llround(z * 400), std::llround(e * 400)};
}

void plan(Planner& planner, double now, const PerAxis<std::int64_t>& target, double speed, const Mix& mix) {
  const auto steps = target[axis_e] - planner.planned_position()[axis_e];
  planner.push({target, static_cast<double>(steps) / 400, speed, mix}, now);
}

void run(Planner& planner) {
  while (const auto end = planner.next_event()) planner.advance_to(*end);
}

}  // namespace

TEST_CASE("a single move takes the time of its trapezoid") {
  MoveList list;
  Planner planner({}, list);
  const auto [length, speed] = GENERATE(table<double, double>({{100, 100}, {40, 20}, {5, 100}}));
  plan(planner, 0, at(length), speed, half_half);
  run(planner);

  const double a = 1500, from = 10, to = end_speed;  // x's acceleration, x's jerk, the end of the queue
  double top = speed;
  double ramps = (top * top - from * from) / (2 * a) + (top * top - to * to) / (2 * a);
  if (ramps > length) {
    top = std::sqrt(a * length + (from * from + to * to) / 2);
    ramps = length;
  }
  const double expected = (top - from) / a + (top - to) / a + (length - ramps) / top;
  REQUIRE(list.moves.size() == 1);
  CHECK(list.moves[0].start == Approx(start_delay));
  CHECK(list.moves[0].end - list.moves[0].start == Approx(expected).epsilon(1e-9));
}

TEST_CASE("a trapezoid's distance is the integral of its speed") {
  const Trapezoid trapezoid = GENERATE(Trapezoid{10, 5, 40, 0.05, 1500}, Trapezoid{0.4, 5, 40, 18, 1500},
                                       Trapezoid{1, 20, 20, 20, 3000});
  const double total = trapezoid.seconds();
  CHECK(trapezoid.distance(0) == Approx(0).margin(1e-12));
  CHECK(trapezoid.distance(total) == Approx(trapezoid.length));
  const double step = total * 1e-5;
  CHECK(trapezoid.distance(step) / step == Approx(trapezoid.entry).epsilon(0.02).margin(0.02));
  const double before_end = (trapezoid.length - trapezoid.distance(total - step)) / step;
  CHECK(before_end == Approx(trapezoid.exit).epsilon(0.02).margin(0.02));
  double fastest = 0;
  for (double t = 0; t + step < total; t += total / 50) {
    fastest = std::max(fastest, (trapezoid.distance(t + step) - trapezoid.distance(t)) / step);
  }
  CHECK(fastest <= trapezoid.peak() * (1 + 1e-6));
}

TEST_CASE("no move enters faster than the previous one exits, or than its acceleration allows") {
  MoveList list;
  MotionLimits limits;
  Planner planner(limits, list);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> step(-2, 2), speed(5, 120);
  double x = 50, y = 50, e = 0, length = 0;
  planner.set_position(at(x, y));
  double now = 0;
  for (int i = 0; i < 500; ++i) {
    if (!planner.has_room()) {
      now = *planner.next_event();
      planner.advance_to(now);
    }
    x += step(random);
    y += step(random);
    plan(planner, now, at(x, y, 0, e += 0.05), speed(random), half_half);
  }
  run(planner);
  double previous_end = start_delay;
  for (const ExecutedMove& move : list.moves) {
    CHECK(move.start == Approx(previous_end).margin(start_delay + 1e-9));
    const double way = std::hypot(move.to.x - move.from.x, move.to.y - move.from.y);
    length += way;
    CHECK(way / (move.end - move.start) <= 120.0 * (1 + 1e-9));
    previous_end = move.end;
  }
  CHECK(list.moves.back().to.x == Approx(x).margin(0.5 / 80));
  // Never slower than stopping at every corner, never faster than without acceleration.
  CHECK(previous_end < 500 * 2 * std::sqrt(2 * 2.9 / 1500) + length / 5);
  CHECK(previous_end > length / 120);
}

TEST_CASE("a straight line in pieces takes as long as in one") {
  MoveList pieces, whole;
  Planner a({}, pieces), b({}, whole);
  double now = 0;
  for (int i = 1; i <= 20; ++i) {
    if (!a.has_room()) a.advance_to(now = *a.next_event());
    plan(a, now, at(5.0 * i), 60, half_half);
  }
  plan(b, 0, at(100), 60, half_half);
  run(a);
  run(b);
  const auto spent = [](const MoveList& list) { return list.moves.back().end - list.moves.front().start; };
  CHECK(spent(pieces) == Approx(spent(whole)).epsilon(1e-9));
}

TEST_CASE("a right-angled corner is taken at jerk speed") {
  MoveList list;
  Planner planner({}, list);
  plan(planner, 0, at(50), 50, half_half);
  plan(planner, 0, at(50, 50), 50, half_half);
  run(planner);
  // From rest at 10 mm/s (the jerk) to 50; down to 10, at which neither axis jumps by more than its jerk.
  const double ramps = (50.0 * 50 - 100) / 1500;
  const double expected = 2 * 40.0 / 1500 + (50 - ramps) / 50;
  CHECK(list.moves[0].end - list.moves[0].start == Approx(expected).epsilon(1e-9));
}

TEST_CASE("speed and acceleration keep within every axis's limits") {
  MoveList list;
  Planner planner({}, list);
  plan(planner, 0, at(0, 0, 5), 100, half_half);
  run(planner);
  CHECK(list.moves[0].end - list.moves[0].start > 5.0 / 10);            // z: 10 mm/s
  CHECK(list.moves[0].end - list.moves[0].start < 5.0 / 10 + 2 * 0.1);  // plus the ramps at 100 mm/s²
}

TEST_CASE("moves of fewer than six steps join the next one, and nothing is lost") {
  MoveList list;
  Planner planner({}, list);
  for (int i = 1; i <= 10; ++i) plan(planner, 0, {2 * i, 0, 0, 0}, 20, half_half);
  CHECK(planner.queued() == 3);
  run(planner);
  CHECK(planner.executed_position()[axis_x] == 18);
  CHECK(planner.planned_position()[axis_x] == 18);
}

TEST_CASE("the queue holds fifteen moves") {
  MoveList list;
  Planner planner({}, list);
  for (int i = 1; i <= 15; ++i) {
    REQUIRE(planner.has_room());
    plan(planner, 0, at(i), 20, half_half);
  }
  CHECK_FALSE(planner.has_room());
  planner.advance_to(*planner.next_event());
  CHECK(planner.has_room());
  CHECK(list.moves.size() == 1);
}

TEST_CASE("every step of E goes to one feeder, according to the mixture's shares") {
  SECTION("half and half") {
    FeederSplit split;
    CHECK(split.split(5000, {32768, 32768, 0}) == PerFeeder<std::int64_t>{2500, 2500, 0});
  }
  SECTION("ten to one") {
    FeederSplit split;
    CHECK(split.split(5000, {32768, 3276, 0}) == PerFeeder<std::int64_t>{4546, 454, 0});
  }
  SECTION("in any pieces, for every number of feeders") {
    const std::size_t feeders = GENERATE(range(std::size_t{2}, max_feeders + 1));
    std::mt19937 random(11);
    std::uniform_int_distribution<std::int64_t> steps(-40, 60);
    std::uniform_int_distribution<std::int32_t> factor(0, 32768);
    FeederSplit split;
    Factors factors{32768, 9000, 700};
    for (std::size_t f = 1; f < max_feeders; ++f) factors[f] = f < feeders ? factor(random) : 0;
    PerFeeder<std::int64_t> sum{};
    std::int64_t total = 0;
    for (int i = 0; i < 5000; ++i) {
      const std::int64_t n = steps(random);
      const auto given = split.split(n, factors);
      CHECK(std::accumulate(given.begin(), given.end(), std::int64_t{0}) == n);
      for (std::size_t f = 0; f < max_feeders; ++f) sum[f] += given[f];
      total += n;
      for (std::size_t f = 0; f < max_feeders; ++f) {
        CHECK(std::abs(static_cast<double>(sum[f]) - static_cast<double>(total) * shares_of(factors)[f]) <=
              2);
      }
    }
  }
  SECTION("while mixtures change") {
    std::mt19937 random(5);
    std::uniform_int_distribution<std::int32_t> factor(0, 3);
    FeederSplit split;
    PerFeeder<double> asked{};
    PerFeeder<std::int64_t> sum{};
    for (int i = 0; i < 5000; ++i) {
      const Factors factors{32768, factor(random) * 9000, factor(random) / 3 * 20000};
      const auto given = split.split(i % 17, factors);
      for (std::size_t f = 0; f < 3; ++f) {
        if (factors[f] == 0) CHECK(given[f] == 0);
        asked[f] += (i % 17) * shares_of(factors)[f];
        sum[f] += given[f];
        CHECK(std::abs(static_cast<double>(sum[f]) - asked[f]) <= 2);
      }
    }
  }
}

TEST_CASE("an abrupt stop ends the running move where it is") {
  MoveList list;
  Planner planner({}, list);
  plan(planner, 0, at(100, 0, 0, 10), 50, half_half);
  plan(planner, 0, at(100, 100, 0, 20), 50, half_half);
  planner.abort(start_delay + 1);
  CHECK(planner.still());
  REQUIRE(list.moves.size() == 1);
  CHECK(list.moves[0].to.x > 40);
  CHECK(list.moves[0].to.x < 50);
  CHECK(list.moves[0].filament == Approx(list.moves[0].to.x / 10).margin(2.0 / 400));
  CHECK(planner.planned_position() == planner.executed_position());
}

TEST_CASE("a mixture of zeros stops the machine for ever") {
  MoveList list;
  Planner planner({}, list);
  plan(planner, 0, at(10), 50, Mix{});
  plan(planner, 0, at(20, 0, 0, 1), 50, Mix{});
  planner.advance_to(1000);
  CHECK(planner.stuck());
  CHECK_FALSE(planner.next_event());
  CHECK(list.moves.size() == 1);
}

namespace {

struct Events : MoveList {
  std::vector<Starvation> starvations;
  std::vector<std::pair<double, std::size_t>> fill;
  void starved(const Starvation& starvation) override { starvations.push_back(starvation); }
  void queue_changed(double time, std::size_t queued) override { fill.emplace_back(time, queued); }
};

}  // namespace

TEST_CASE("a queue that runs dry in mid-curve is reported with time, place and duration") {
  Events events;
  Planner planner({}, events);
  plan(planner, 0, at(10, 0, 0, 1), 20, half_half);
  const double dry = *planner.next_event();
  planner.advance_to(dry + 3);
  plan(planner, dry + 3, at(20, 0, 0, 2), 20, half_half);
  run(planner);
  REQUIRE(events.starvations.size() == 1);
  CHECK(events.starvations[0].time == Approx(dry));
  CHECK(events.starvations[0].place == Position{10, 0, 0});
  CHECK(events.starvations[0].seconds == Approx(3 + start_delay));
  CHECK(events.starvations[0].dry);
}

TEST_CASE("a move that arrives while the last one brakes is a stop of no duration") {
  Events events;
  Planner planner({}, events);
  plan(planner, 0, at(10, 0, 0, 1), 20, half_half);
  plan(planner, start_delay + 0.2, at(20, 0, 0, 2), 20, half_half);
  run(planner);
  REQUIRE(events.starvations.size() == 1);
  CHECK(events.starvations[0].seconds == 0);
  CHECK_FALSE(events.starvations[0].dry);
}

TEST_CASE("no starvation is reported") {
  Events events;
  Planner planner({}, events);
  SECTION("while moves are queued") {
    plan(planner, 0, at(10, 0, 0, 1), 20, half_half);
    plan(planner, 0, at(20, 0, 0, 2), 20, half_half);
  }
  SECTION("before a travel") {
    plan(planner, 0, at(10, 0, 0, 1), 20, half_half);
    run(planner);
    plan(planner, 100, at(20, 0, 0, 1), 20, half_half);
  }
  SECTION("where a command waits for the stop") {
    plan(planner, 0, at(10, 0, 0, 1), 20, half_half);
    planner.stop_is_meant();
    run(planner);
    plan(planner, 100, at(20, 0, 0, 2), 20, half_half);
  }
  run(planner);
  CHECK(events.starvations.empty());
}

TEST_CASE("every change of the queue is reported, whatever the steps of time") {
  std::vector<std::pair<double, std::size_t>> fills[2];
  std::vector<double> ends[2];
  for (const int fine : {0, 1}) {
    Events events;
    Planner planner({}, events);
    std::mt19937 random(8);
    std::uniform_real_distribution<double> step(-1, 1);
    double now = 0, x = 100, y = 100, e = 0;
    planner.set_position(at(x, y));
    for (int i = 0; i < 400; ++i) {
      const double next = now + 0.013 * (i % 3);
      for (double t = now; fine == 1 && t < next; t += 0.001) planner.advance_to(t);
      now = next;
      planner.advance_to(now);
      if (!planner.has_room()) continue;
      plan(planner, now, at(x += step(random), y += step(random), 0, e += 0.02), 20, half_half);
    }
    run(planner);
    fills[fine] = events.fill;
    for (const ExecutedMove& move : events.moves) ends[fine].push_back(move.end);
    std::size_t before = 0;
    for (const auto& [time, queued] : events.fill) {
      CHECK((queued == before + 1 || queued + 1 == before));
      CHECK(queued <= Planner::usable_blocks);
      before = queued;
    }
    CHECK(before == 0);
  }
  CHECK(ends[0] == ends[1]);
  CHECK(fills[0] == fills[1]);
}

TEST_CASE("the step rate of the board limits the speed") {
  MoveList list;
  MotionLimits limits;
  limits.step_rate = 4000;  // 50 mm/s in x
  Planner planner(limits, list);
  plan(planner, 0, at(100), 120, half_half);
  run(planner);
  CHECK(list.moves[0].speed.peak() == Approx(50));
}

TEST_CASE("short moves are stretched towards 20 ms only while the queue is short") {
  Events events;
  Planner planner({}, events);
  for (int i = 1; i <= 15; ++i) plan(planner, 0, at(i, 0, 0, 0.05 * i), 100, half_half);  // 10 ms each
  run(planner);
  // Two to seven are waiting (the running one does not): time + 2·(20 ms − time) ÷ waiting.
  CHECK(events.moves[0].speed.nominal == Approx(100));
  CHECK(events.moves[2].speed.nominal == Approx(1 / 0.020));
  CHECK(events.moves[4].speed.nominal == Approx(1 / (0.010 + 0.020 / 3)));
  CHECK(events.moves[10].speed.nominal == Approx(100));
}
