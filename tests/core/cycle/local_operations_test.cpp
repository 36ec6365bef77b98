#include "core/cycle/local_operations.hpp"

#include <catch2/catch.hpp>

#include "core/curve/clearance.hpp"
#include "core/cycle/cycle_objective.hpp"
#include "core/cycle/first_cycle.hpp"
#include "tests/core/support/shapes.hpp"

using namespace unicursal::core;
using namespace unicursal::core::test;

namespace {

Tour first_tour(const Polygon& domain, double d, std::uint64_t seed) {
  Random random(seed);
  const auto graph = make_cell_graph(domain, d, random);
  REQUIRE(graph);
  auto cycle = first_cycle(*graph);
  REQUIRE(cycle);
  return std::move(cycle->tour);
}

/// Asks for turning directions on one side; the other side is isotropic.
Demand swirl(const Vec2& p) {
  Demand demand;
  if (p.x() > 6) {
    demand.even_zone = EvenZoneIndex(0);
  } else {
    demand.direction = doubled(std::atan2(p.y() - 5, p.x() - 5));
  }
  return demand;
}

/// Carries out `count` operations found at random, and checks the whole tour after every `every` operations.
std::array<std::size_t, 5> walk(EditableTour& tour, Random& random, std::size_t count, std::size_t every) {
  std::array<std::size_t, 5> found{};
  const std::size_t stops = tour.tour().visited_count();
  for (std::size_t done = 0; done < count;) {
    const auto change = tour.look(tour.random_stop(random), random);
    if (!change) continue;
    tour.apply(*change);
    ++found[static_cast<std::size_t>(change->operation)];
    if (++done % every != 0) continue;
    REQUIRE(tour.consistent());
    REQUIRE(tour.tour().visited_count() == stops);
    REQUIRE(self_intersections(drawn(tour.tour())) == 0);
    REQUIRE(signed_area(drawn(tour.tour()).vertices) > 0);
  }
  return found;
}

}  // namespace

TEST_CASE("local operations of every kind keep one Hamiltonian cycle") {
  const Polygon domain = GENERATE(rectangle(10, 10), square_with_hole(), rectangle(30, 1.4));
  Random random(5);
  EditableTour tour(first_tour(domain, 0.9, 11));
  REQUIRE(tour.consistent());
  // At first the tour is checked after every single operation, so that a fault cannot hide among others.
  walk(tour, random, 200, 1);
  const auto found = walk(tour, random, 5000, 50);
  for (const int operation : {1, 2, 3, 4}) {
    CAPTURE(operation);
    CHECK(found[static_cast<std::size_t>(operation)] > 20);
  }
}

TEST_CASE("a million local operations on random graphs keep one Hamiltonian cycle", "[long]") {
  Random random(6);
  for (std::uint64_t k = 0; k < 100; ++k) {
    const Polygon island = random_island(random, 8, 6);
    Random seeds(k);
    const auto graph = make_cell_graph(island, 0.9, seeds);
    if (!graph) continue;
    auto cycle = first_cycle(*graph);
    if (!cycle || std::count(cycle->tour.free.begin(), cycle->tour.free.end(), 1) < 30) continue;
    EditableTour tour(std::move(cycle->tour));
    walk(tour, random, 10000, 500);
  }
}

TEST_CASE("the objective is kept up to date change by change") {
  EditableTour tour(first_tour(square_with_hole(), 0.8, 3));
  const auto dear_to_cross = [](const Vec2& a, const Vec2& b) {
    return (a.x() < 4) != (b.x() < 4) ? 5.0 : 0.1 * (b - a).norm();
  };
  ObjectiveWeights weights;
  weights.length = 0.9 * drawn(tour.tour()).length();
  CycleObjective objective(tour, swirl, dear_to_cross, weights);
  Random random(9);
  for (int done = 0; done < 4000;) {
    const auto change = tour.look(tour.random_stop(random), random);
    if (!change) continue;
    const double before = objective.value(), rise = objective.difference(*change);
    if (random.below(2) == 0) continue;  // a refused change must not leave a trace
    objective.accept();
    tour.apply(*change);
    REQUIRE(objective.value() == Approx(before + rise));
    if (++done % 100 == 0) REQUIRE(objective.value() == Approx(objective.recomputed()).epsilon(1e-9));
  }
}

TEST_CASE("flaws are the free stops that cost more than a good chord would cost") {
  EditableTour tour(first_tour(rectangle(10, 10), 0.8, 4));
  CycleObjective objective(tour, swirl, {}, {});
  const std::size_t at_first = objective.flaws().size();
  CHECK(at_first > 0);
  Random random(2);
  // If only improvements are accepted, flaws become fewer; the list must not hold a stop twice.
  for (int k = 0; k < 400000; ++k) {
    const auto change = tour.look(tour.random_stop(random), random);
    if (!change || objective.difference(*change) >= 0) continue;
    objective.accept();
    tour.apply(*change);
  }
  std::vector<StopIndex> flaws = objective.flaws();
  CHECK(flaws.size() < at_first);
  std::sort(flaws.begin(), flaws.end());
  CHECK(std::adjacent_find(flaws.begin(), flaws.end()) == flaws.end());
}

TEST_CASE("labels keep the order however often stops move to the same place") {
  // A ring of stops. Again and again one of them moves behind stop 0, which halves the room for labels there.
  constexpr std::size_t stops = 12;
  constexpr StopIndex zero(0);
  Tour ring;
  for (std::size_t s = 0; s < stops; ++s) {
    ring.next.push_back(StopIndex((s + 1) % stops));
    ring.before.push_back(StopIndex((s + stops - 1) % stops));
  }
  const auto link = [&](StopIndex a, StopIndex b) {
    ring.next[a] = b;
    ring.before[b] = a;
  };
  TourOrder order(ring);
  Random random(3);
  for (int k = 0; k < 500; ++k) {
    const StopIndex moved(1 + random.below(stops - 1));
    link(ring.before[moved], ring.next[moved]);
    const StopIndex after = ring.next[zero];
    link(zero, moved);
    link(moved, after);
    order.fit(ring, moved, moved);
    for (StopIndex s = ring.next[zero]; s != zero; s = ring.next[s]) {
      const StopIndex next = ring.next[s];
      REQUIRE(order.within(zero, s, ring.before[zero]));
      if (next != zero) {
        REQUIRE(order.within(s, next, ring.before[zero]));
        REQUIRE_FALSE(order.within(next, s, ring.before[zero]));
      }
    }
  }
}
