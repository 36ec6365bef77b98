#include "core/cycle/shuffle.hpp"

#include <catch2/catch.hpp>

#include <algorithm>

#include "core/curve/clearance.hpp"
#include "core/cycle/first_cycle.hpp"
#include "core/cycle/population.hpp"
#include "tests/core/support/shapes.hpp"

using namespace unicursal::core;
using namespace unicursal::core::test;

namespace {

Tour first_tour(std::uint64_t seed) {
  Random random(seed);
  auto cycle = first_cycle(*make_cell_graph(rectangle(12, 12), 0.9, random));
  return std::move(cycle->tour);
}

Demand upwards(const Vec2&) {
  Demand demand;
  demand.direction = doubled(1.3);
  return demand;
}

ShuffleOptions quick() {
  ShuffleOptions options;
  options.sweeps = 60;
  return options;
}

/// Share of the tour's edges within 0.55 rad of the asked direction.
double along(const Tour& tour) {
  const Curve curve = drawn(tour);
  double good = 0, all = 0;
  for (std::size_t i = 0; i < curve.size(); ++i) {
    const Vec2 u = curve.vertices[curve.after(i)] - curve.vertices[i];
    const double off = std::remainder(std::atan2(u.y(), u.x()) - 1.3, 3.14159265358979);
    all += u.norm();
    if (std::abs(off) < 0.55) good += u.norm();
  }
  return good / all;
}

}  // namespace

TEST_CASE("annealing and the paper's rule both align a cycle with the asked direction") {
  ShuffleOptions options = quick();
  options.sweeps = 200;
  options.rule = GENERATE(ShuffleOptions::Rule::annealing, ShuffleOptions::Rule::algorithm_1);
  Tour tour = first_tour(4);
  const auto stops = tour.visited_count();
  const double before = along(tour);
  Random random(1);
  const ShuffleReport report = shuffle(tour, upwards, {}, options, random);
  CHECK(report.after < report.before);
  CHECK(report.accepted > 0);
  CHECK(report.found <= report.looks);
  CHECK(along(tour) > before + 0.15);
  CHECK(tour.visited_count() == stops);
  CHECK(self_intersections(drawn(tour)) == 0);
}

TEST_CASE(
    "stopped at any sweep, the optimiser returns a cycle that is not worse, and the same one every time") {
  const int most = GENERATE(0, 1, 7, 30);
  const auto run = [&] {
    ShuffleOptions options = quick();
    int left = most;
    options.may_continue = [&left] { return left-- > 0; };
    Tour tour = first_tour(4);
    Random random(1);
    const ShuffleReport report = shuffle(tour, upwards, {}, options, random);
    CHECK(report.after <= report.before);
    return tour.next;
  };
  CHECK(run() == run());
}

TEST_CASE("the result of a population does not depend on threads and is better than its first cycle") {
  ShuffleOptions options = quick();
  options.sweeps = 10;
  options.champions = 3;
  options.candidates = 2;
  options.generations = 3;
  const auto run = [&](int threads) {
    Workers workers(threads);
    options.workers = &workers;
    Tour tour = first_tour(4);
    Random random(1);
    const ShuffleReport report = shuffle(tour, upwards, {}, options, random);
    CHECK(report.after < report.before);
    // K · C clones in each round.
    CHECK(report.looks >=
          3 * 6 * 10 * static_cast<std::size_t>(std::count(tour.free.begin(), tour.free.end(), 1)));
    return tour.next;
  };
  const auto one = run(1);
  CHECK(run(2) == one);
  CHECK(run(5) == one);
}

TEST_CASE("a large tour is improved in windows, and the result does not depend on threads") {
  ShuffleOptions options = quick();
  options.sweeps = 40;
  Random seeds(3);
  const auto cycle = first_cycle(*make_cell_graph(rectangle(40, 36), 0.9, seeds));
  REQUIRE(cycle->tour.visited_count() > 4500);
  const auto run = [&](int threads) {
    Workers workers(threads);
    options.workers = &workers;
    Tour tour = cycle->tour;
    Random random(1);
    const ShuffleReport report = shuffle(tour, upwards, {}, options, random);
    CHECK(report.after < report.before);
    CHECK(self_intersections(drawn(tour)) == 0);
    return tour.next;
  };
  const auto one = run(1);
  CHECK(run(2) == one);
}

TEST_CASE("champions are the best cycle and the cycles farthest from those chosen") {
  std::vector<Tour> tours(4, first_tour(4));
  const auto shift = [](Tour& tour, std::size_t count) {
    for (const StopIndex s : IndexRange<StopIndex>(count)) tour.leave[s] = PlanarGraph::twin(tour.leave[s]);
  };
  shift(tours[1], 3);
  shift(tours[2], 10);
  CHECK(distance(tours[0], tours[1]) == 3);
  CHECK(distance(tours[1], tours[2]) == 7);
  CHECK(diverse(tours, {5, 4, 6, 7}, 2) == std::vector<std::size_t>{1, 2});
  CHECK(diverse(tours, {1, 4, 6, 7}, 3) == std::vector<std::size_t>{0, 2, 1});
  // The last tour equals the first, so only three tours differ.
  CHECK(diverse(tours, {1, 4, 6, 7}, 4).size() == 3);
}
