#include "core/geometry/lattice.hpp"

#include <catch2/catch.hpp>

#include "core/geometry/lattice_owners.hpp"
#include "tests/core/support/shapes.hpp"

using namespace unicursal::core;
using namespace unicursal::core::test;

TEST_CASE("sample weights add up to the polygon's area, first moments to its centroid") {
  const Polygon polygon = GENERATE(rectangle(10, 7.3), square_with_hole());
  const double pitch = GENERATE(0.21, 1.7, 30.0);
  const Lattice lattice = sample(polygon, pitch);
  Vec2 moment(0, 0);
  for (std::size_t k = 0; k < lattice.size(); ++k) {
    moment += lattice.weight(k) * (lattice.position(k));
  }
  CHECK(lattice.total_weight() == Approx(area(polygon)).epsilon(1e-6));
  const Vec2 expected = bounds(polygon).center();  // both shapes are symmetric
  CHECK((moment / lattice.total_weight() - expected).norm() < 1e-5 * bounds(polygon).size().norm());
}

TEST_CASE("random islands: weights add up") {
  Random random(11);
  for (int k = 0; k < 50; ++k) {
    const Polygon island = random_island(random, 10, 4);
    REQUIRE(sample(island, 0.3).total_weight() == Approx(area(island)).epsilon(1e-5));
  }
}

TEST_CASE("the nearest segment of every sample agrees with brute force") {
  Random random(5);
  const Lattice lattice = sample(rectangle(6, 5), 0.17);
  std::vector<Segment> segments;
  for (int k = 0; k < 40; ++k) {
    const Vec2 a(random.uniform(0, 6), random.uniform(0, 5));
    const Vec2 b = k % 5 == 0 ? a : Vec2(a + Vec2(random.uniform(-1, 1), random.uniform(-1, 1)));
    segments.push_back({a, b});
  }
  segments.push_back({{1, 2}, {4, 2}});  // horizontal and vertical ones
  segments.push_back({{3, 1}, {3, 4}});
  LatticeOwners owners(lattice);
  owners.assign(segments);
  for (std::size_t k = 0; k < lattice.size(); ++k) {
    if (lattice.weight(k) <= 0) continue;
    const Vec2 p = lattice.position(k);
    double best = 1e9;
    for (const Segment& s : segments) best = std::min(best, distance_to_segment(p, s.a, s.b));
    REQUIRE(owners.owner(k) >= 0);
    const Segment& own = segments[static_cast<std::size_t>(owners.owner(k))];
    REQUIRE(distance_to_segment(p, own.a, own.b) == Approx(best).margin(1e-4));
    REQUIRE(std::sqrt(owners.distance2(k)) == Approx(best).margin(1e-3));
  }
}

TEST_CASE("owners are right while segments move, with rebuilt lists and with kept ones") {
  Random random(9);
  const Polygon island = square_with_hole();
  const Lattice lattice = sample(island, 0.1);
  std::vector<Segment> segments;
  for (int k = 0; k < 60; ++k) {
    const Vec2 a(random.uniform(0, 12), random.uniform(0, 12));
    segments.push_back({a, a + Vec2(random.uniform(-1, 1), random.uniform(-1, 1))});
  }
  segments.push_back({{0.5, 0.5}, {11.5, 11}});  // much longer than the others
  Workers two(2);
  LatticeOwners kept(lattice, {0.3, false, nullptr}), shared(lattice, {0.3, false, &two});
  for (int round = 0; round < 12; ++round) {
    kept.assign(segments);
    shared.assign(segments);
    double moment = 0;
    for (std::size_t k = 0; k < lattice.size(); ++k) {
      REQUIRE(kept.owner(k) == shared.owner(k));
      if (lattice.weight(k) <= 0) continue;
      double best = 1e9;
      for (const Segment& s : segments)
        best = std::min(best, distance_to_segment(lattice.position(k), s.a, s.b));
      REQUIRE(std::sqrt(kept.distance2(k)) == Approx(best).margin(1e-5));
      moment += lattice.weight(k) * best * best;
    }
    CHECK(kept.second_moment() == Approx(moment).epsilon(1e-5));
    REQUIRE(kept.second_moment() == shared.second_moment());
    for (std::size_t s = 0; s < segments.size(); ++s) {
      REQUIRE(kept.pulls()[s].all == shared.pulls()[s].all);
      REQUIRE(kept.pulls()[s].end == shared.pulls()[s].end);
    }
    for (Segment& s : segments) {
      const Vec2 move = 0.07 * Vec2(random.uniform(-1, 1), random.uniform(-1, 1));
      s = {s.a + move, s.b - move};
    }
  }
}

TEST_CASE("samples out of reach still get an owner") {
  const Lattice lattice = sample(rectangle(20, 1), 0.25);
  LatticeOwners owners(lattice);
  owners.assign({{{0.5, 0.5}, {0.5, 0.5}}});
  for (std::size_t k = 0; k < lattice.size(); ++k) {
    if (lattice.weight(k) > 0) REQUIRE(owners.owner(k) == 0);
  }
}
