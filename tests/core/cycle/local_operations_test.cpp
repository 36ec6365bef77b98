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

StopIndex random_stop(const TourWindow& window, Dice& dice) {
  return window.movable[dice.below(window.movable.size())];
}

/// Carries out `count` operations found at random, and checks the whole tour after every `every` operations.
std::array<std::size_t, 5> walk(EditableTour& tour, Dice& dice, std::size_t count, std::size_t every) {
  std::array<std::size_t, 5> found{};
  const std::size_t stops = tour.tour().visited_count();
  TourWindow window = whole_window(tour.tour());
  for (std::size_t done = 0; done < count;) {
    const auto change = tour.look(random_stop(window, dice), dice);
    if (!change) continue;
    tour.apply(*change, window);
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
  Dice dice(5);
  EditableTour tour(first_tour(domain, 0.9, 11));
  REQUIRE(tour.consistent());
  // At first the tour is checked after every single operation, so that a fault cannot hide among others.
  walk(tour, dice, 200, 1);
  const auto found = walk(tour, dice, 5000, 50);
  for (const int operation : {1, 2, 3, 4}) {
    CAPTURE(operation);
    CHECK(found[static_cast<std::size_t>(operation)] > 20);
  }
}

TEST_CASE("a million local operations on random graphs keep one Hamiltonian cycle", "[long]") {
  Random random(6);
  Dice dice(6);
  for (std::uint64_t k = 0; k < 100; ++k) {
    const Polygon island = random_island(random, 8, 6);
    Random seeds(k);
    const auto graph = make_cell_graph(island, 0.9, seeds);
    if (!graph) continue;
    auto cycle = first_cycle(*graph);
    if (!cycle || std::count(cycle->tour.free.begin(), cycle->tour.free.end(), 1) < 30) continue;
    EditableTour tour(std::move(cycle->tour));
    walk(tour, dice, 10000, 500);
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
  TourWindow window = whole_window(tour.tour());
  Dice dice(9);
  // The sums over the whole tour are handed back now and then, and a new follower goes on from there.
  for (int round = 0; round < 4; ++round) {
    std::vector<WindowObjective> followers{{objective, window}};
    for (int done = 0; done < 1000;) {
      const auto change = tour.look(random_stop(window, dice), dice);
      if (!change) continue;
      const double before = objective.value(), rise = followers[0].difference(*change);
      if (dice.below(2) == 0) continue;  // a refused change must not leave a trace
      followers[0].accept();
      tour.apply(*change, window);
      ++done;
      REQUIRE(objective.value() - before == Approx(rise).margin(1e-9));
    }
    objective.join(followers);
  }
}

TEST_CASE("flaws are the movable stops that cost more than a good chord would cost") {
  EditableTour tour(first_tour(rectangle(10, 10), 0.8, 4));
  CycleObjective objective(tour, swirl, {}, {});
  TourWindow window = whole_window(tour.tour());
  WindowObjective follower(objective, window);
  const std::size_t at_first = follower.flaws().size();
  CHECK(at_first > 0);
  Dice dice(2);
  // If only improvements are accepted, flaws become fewer; the list must not hold a stop twice.
  for (int k = 0; k < 400000; ++k) {
    const auto change = tour.look(random_stop(window, dice), dice);
    if (!change || follower.difference(*change) >= 0) continue;
    follower.accept();
    tour.apply(*change, window);
  }
  std::vector<StopIndex> flaws = follower.flaws();
  CHECK(flaws.size() < at_first);
  std::sort(flaws.begin(), flaws.end());
  CHECK(std::adjacent_find(flaws.begin(), flaws.end()) == flaws.end());
}

TEST_CASE("changes in several windows, carried out one window after the other, keep one Hamiltonian cycle") {
  const Polygon domain = GENERATE(rectangle(24, 20), square_with_hole());
  EditableTour tour(first_tour(domain, 0.9, 7));
  const std::size_t stops = tour.tour().visited_count();
  Random random(8);
  std::array<std::size_t, 5> found{};
  std::size_t refused = 0;
  for (int cut = 0; cut < 20; ++cut) {
    std::vector<TourWindow> windows =
        tour.divide(random.uniform(4, 9), {random.uniform(0, 9), random.uniform(0, 9)});
    const Per<StopIndex, StopIndex> before = tour.tour().next;
    Per<StopIndex, char> movable(tour.tour().stop_count(), 0);
    for (TourWindow& window : windows) {
      Dice dice(static_cast<std::uint64_t>(cut));
      for (const StopIndex s : window.movable) movable[s] = 1;
      for (int look = 0; look < 4000; ++look) {
        const auto change = tour.look(random_stop(window, dice), dice);
        if (!change) continue;
        if (!tour.keeps_ends(*change, window)) {
          ++refused;
          continue;
        }
        tour.apply(*change, window);
        ++found[static_cast<std::size_t>(change->operation)];
      }
    }
    REQUIRE(tour.tour().sequence().size() == stops);
    for (const StopIndex s : movable.indices()) {
      if (!movable[s]) REQUIRE((tour.tour().next[s] == before[s] || movable[tour.tour().next[s]]));
    }
  }
  REQUIRE(self_intersections(drawn(tour.tour())) == 0);
  for (const int operation : {1, 2, 3, 4}) {
    CAPTURE(operation);
    CHECK(found[static_cast<std::size_t>(operation)] > 20);
  }
  CHECK(refused > 0);
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
    if (order.fit(ring, moved, moved) == 0) order.label(ring.sequence());
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
