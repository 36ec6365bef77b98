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

std::size_t visited(const Tour& tour) {
  return static_cast<std::size_t>(
      std::count_if(tour.next.begin(), tour.next.end(), [](StopIndex s) { return s >= 0; }));
}

/// Directions that turn, and an isotropic half.
Demand swirl(const Vec2& p) {
  Demand demand;
  if (p.x() > 6) {
    demand.even_zone = 0;
  } else {
    demand.direction = doubled(std::atan2(p.y() - 5, p.x() - 5));
  }
  return demand;
}

/// Carries out `count` operations found at random, looking at the whole tour every `every` of them.
std::array<std::size_t, 5> walk(EditableTour& tour, Random& random, std::size_t count, std::size_t every) {
  std::array<std::size_t, 5> found{};
  const std::size_t stops = visited(tour.tour());
  for (std::size_t done = 0; done < count;) {
    const auto change = tour.look(tour.random_stop(random), random);
    if (!change) continue;
    tour.apply(*change);
    ++found[static_cast<std::size_t>(change->operation)];
    if (++done % every != 0) continue;
    REQUIRE(tour.consistent());
    REQUIRE(visited(tour.tour()) == stops);
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
  // Each operation by itself while few have been carried out: a fault would not hide among others.
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

TEST_CASE("the objective follows change by change") {
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
    if (random.below(2) == 0) continue;  // refused ones leave no trace
    objective.accept();
    tour.apply(*change);
    REQUIRE(objective.value() == Approx(before + rise));
    if (++done % 100 == 0) REQUIRE(objective.value() == Approx(objective.recomputed()).epsilon(1e-9));
  }
}

TEST_CASE("flaws are the free stops that cost more than a good chord would") {
  EditableTour tour(first_tour(rectangle(10, 10), 0.8, 4));
  CycleObjective objective(tour, swirl, {}, {});
  const std::size_t at_first = objective.flaws().size();
  CHECK(at_first > 0);
  Random random(2);
  // Downhill only: flaws get fewer, and the list holds no stop twice.
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

TEST_CASE("labels keep the order however often one place is used") {
  // A ring of stops; again and again one is taken out and put behind stop 0, which halves the room there.
  constexpr StopIndex stops = 12;
  Tour ring;
  for (StopIndex s = 0; s < stops; ++s) {
    ring.next.push_back((s + 1) % stops);
    ring.before.push_back((s + stops - 1) % stops);
  }
  const auto link = [&](StopIndex a, StopIndex b) {
    ring.next[static_cast<std::size_t>(a)] = b;
    ring.before[static_cast<std::size_t>(b)] = a;
  };
  TourOrder order(ring);
  Random random(3);
  for (int k = 0; k < 500; ++k) {
    const auto moved = static_cast<StopIndex>(1 + random.below(stops - 1));
    const auto m = static_cast<std::size_t>(moved);
    link(ring.before[m], ring.next[m]);
    const StopIndex after = ring.next[0];
    link(0, moved);
    link(moved, after);
    order.fit(ring, moved, moved);
    for (StopIndex s = ring.next[0]; s != 0; s = ring.next[static_cast<std::size_t>(s)]) {
      const StopIndex next = ring.next[static_cast<std::size_t>(s)];
      REQUIRE(order.within(0, s, ring.before[0]));
      if (next != 0) {
        REQUIRE(order.within(s, next, ring.before[0]));
        REQUIRE_FALSE(order.within(next, s, ring.before[0]));
      }
    }
  }
}
