#include "core/thin/medial_axis.hpp"

#include <catch2/catch.hpp>

#include "tests/core/support/shapes.hpp"

using namespace unicursal::core;
using namespace unicursal::core::test;

TEST_CASE("every node of a medial axis is a circle's centre that touches the border and does not cross it") {
  Random random(5);
  for (int k = 0; k < 60; ++k) {
    const Polygon island = random_island(random, random.uniform(1, 20), 5);
    const MedialAxis axis = medial_axis(island, 0.3);
    REQUIRE(axis.size() > 3);
    CAPTURE(k);
    for (const AxisNode& node : axis) {
      REQUIRE(node.radius == Approx(distance_to_border(island, node.position)).margin(2e-4));
      for (const std::size_t next : node.next) {
        REQUIRE((axis[next].position - node.position).norm() < 0.31);
        REQUIRE(contains(island, (axis[next].position + node.position) / 2));
      }
    }
  }
}

TEST_CASE("the medial axis of a bar is its centre line with two branches into the corners at either end") {
  const MedialAxis axis = medial_axis(rectangle(20, 2), 0.5);
  double on_line = 0, in_corners = 0;
  for (const AxisNode& node : axis) {
    for (const std::size_t next : node.next) {
      const Vec2 d = axis[next].position - node.position;
      (std::abs(d.y()) < 1e-9 ? on_line : in_corners) += d.norm() / 2;
    }
  }
  CHECK(on_line == Approx(18).epsilon(1e-4));
  CHECK(in_corners == Approx(4 * std::sqrt(2)).epsilon(2e-3));
}
