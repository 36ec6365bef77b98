#include "core/graph/cell_graph.hpp"

#include <catch2/catch.hpp>

#include <map>
#include <numeric>

#include "core/graph/matching.hpp"
#include "core/graph/refined_graph.hpp"
#include "core/graph/seeds.hpp"
#include "tests/core/support/cell_graph_check.hpp"
#include "tests/core/support/shapes.hpp"

using namespace unicursal::core;
using namespace unicursal::core::test;

namespace {

Per<EdgeIndex, EdgeEnds> ends_of(const PlanarGraph& graph) {
  Per<EdgeIndex, EdgeEnds> ends;
  for (const EdgeIndex e : graph.edges()) {
    const HalfEdgeIndex h = PlanarGraph::forward(e);
    ends.push_back({graph.origin(h), graph.target(h)});
  }
  return ends;
}

/// Edges between nodes of these numbers.
Per<EdgeIndex, EdgeEnds> edges_between(const std::vector<std::pair<std::size_t, std::size_t>>& numbers) {
  Per<EdgeIndex, EdgeEnds> ends;
  for (const auto& [a, b] : numbers) ends.push_back({NodeIndex(a), NodeIndex(b)});
  return ends;
}

}  // namespace

TEST_CASE("seeds lie inside, about d apart, and no point is far from all seeds") {
  Random random(4);
  const Polygon domain = square_with_hole();
  const double d = 0.8;
  const std::vector<Vec2> seeds = place_seeds(domain, d, random);
  CHECK(static_cast<double>(seeds.size()) == Approx(area(domain) / (std::sqrt(3) / 2 * d * d)).epsilon(0.15));
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    REQUIRE(contains(domain, seeds[i]));
    for (std::size_t j = 0; j < i; ++j) REQUIRE((seeds[i] - seeds[j]).norm() > 0.3 * d);
  }
  for (int k = 0; k < 3000; ++k) {
    const Vec2 p(random.uniform(0, 12), random.uniform(0, 12));
    if (!contains(domain, p)) continue;
    double nearest = 1e9;
    for (const Vec2& seed : seeds) nearest = std::min(nearest, (seed - p).norm());
    REQUIRE(nearest < 1.1 * d);
  }
}

TEST_CASE("no seed lies in a hole, however small the hole is") {
  Random random(15);
  for (int k = 0; k < 200; ++k) {
    Polygon strip = rectangle(12, 0.5);
    for (double x = 0.3; x < 11.7; x += random.uniform(0.2, 0.5))
      strip.holes.push_back(circle({x, random.uniform(0.15, 0.35)}, 0.07, 12, false));
    for (const Vec2& seed : place_seeds(strip, 0.9, random)) REQUIRE(contains(strip, seed));
  }
}

TEST_CASE("rows of seeds run in the asked direction") {
  const double rows = GENERATE(0.0, 0.4, 0.9);
  Random random(5);
  const std::vector<Vec2> seeds = place_seeds(rectangle(20, 20), {1.0, rows, 1}, random);
  double order = 0, pairs = 0;
  for (const Vec2& p : seeds) {
    for (const Vec2& q : seeds) {
      const Vec2 apart = q - p;
      if (apart.norm() == 0 || apart.norm() > 1.3) continue;
      order += std::cos(6 * (std::atan2(apart.y(), apart.x()) - rows));
      ++pairs;
    }
  }
  CHECK(order / pairs > 0.7);  // 1 for a perfect tiling, 0 at random, −1 turned by 30°
}

TEST_CASE("a stretched tiling has as many seeds, farther apart along its rows") {
  Random random(6);
  const Polygon domain = rectangle(30, 20);
  const std::vector<Vec2> plain = place_seeds(domain, {1.0, 0.0, 1}, random);
  const std::vector<Vec2> stretched = place_seeds(domain, {1.0, 0.0, 1.5}, random);
  CHECK(static_cast<double>(stretched.size()) == Approx(static_cast<double>(plain.size())).epsilon(0.05));
  // The relaxation rounds the stretched cells somewhat, so no more than the order is asked for.
  const auto neighbours_along = [](const std::vector<Vec2>& seeds) {
    double spacing = 0, pairs = 0;
    for (const Vec2& p : seeds) {
      for (const Vec2& q : seeds) {
        const Vec2 apart = q - p;
        if (apart.x() <= 0 || apart.x() > 1.6 || std::abs(apart.y()) > 0.3) continue;
        spacing += apart.x();
        ++pairs;
      }
    }
    return spacing / pairs;
  };
  CHECK(neighbours_along(stretched) > 1.1 * neighbours_along(plain));
}

TEST_CASE("cell graphs are cubic, bridgeless and connected, and every face is a disc") {
  Random random(1);
  const Polygon domain = GENERATE(rectangle(10, 10), square_with_hole(), rectangle(40, 0.9));
  const double d = GENERATE(0.7, 1.9);
  const auto graph = make_cell_graph(domain, d, random);
  REQUIRE(graph);
  check_cell_graph(*graph, domain);
}

TEST_CASE("a hole within one cell gets a second seed") {
  Random random(1);
  Polygon domain = rectangle(10, 10);
  for (int k = 0; k < 9; ++k)
    domain.holes.push_back(circle({2.0 + 3 * (k % 3), 2.0 + 3 * (k / 3)}, 0.05, 12, false));
  const auto graph = make_cell_graph(domain, 1.5, random);
  REQUIRE(graph);
  check_cell_graph(*graph, domain);
}

TEST_CASE("without a second seed a hole within one cell is reported, and there is no graph") {
  Polygon domain = rectangle(10, 10);
  domain.holes.push_back(circle({2.5, 5}, 0.1, 12, false));
  std::vector<std::size_t> untouched;
  CHECK_FALSE(clip_to_domain({{2.3, 5}, {7.5, 5}}, domain, untouched));
  REQUIRE(untouched == std::vector<std::size_t>{0});
  CHECK(clip_to_domain({{2.3, 5}, {2.7, 5}, {7.5, 5}}, domain, untouched));
}

TEST_CASE("a non-convex border that cuts cells into pieces gives one face per piece") {
  // A comb with seeds near the tips of two teeth only: their cells reach across the gaps to the other teeth.
  const Polygon comb{{{0, 0},
                      {9, 0},
                      {9, 5},
                      {7, 5},
                      {7, 1},
                      {5.5, 1},
                      {5.5, 5},
                      {3.5, 5},
                      {3.5, 1},
                      {2, 1},
                      {2, 5},
                      {0, 5}},
                     {}};
  std::vector<std::size_t> untouched;
  const auto graph = clip_to_domain({{1, 4.5}, {8, 4.6}}, comb, untouched);
  REQUIRE(graph);
  check_cell_graph(*graph, comb);
}

TEST_CASE("cell graphs have perfect matchings that touch every node once") {
  Random random(9);
  const auto graph = make_cell_graph(square_with_hole(), 0.5, random);
  REQUIRE(graph);
  const auto ends = ends_of(*graph);
  const Per<EdgeIndex, bool> matched = perfect_matching(graph->node_count(), ends);
  REQUIRE(matched.size() == ends.size());
  Per<NodeIndex, int> touched(graph->node_count(), 0);
  for (const EdgeIndex e : ends.indices()) {
    if (!matched[e]) continue;
    ++touched[ends[e].first];
    ++touched[ends[e].second];
  }
  CHECK(touched.values() == std::vector<int>(graph->node_count(), 1));
}

TEST_CASE("a graph without a perfect matching is recognised") {
  CHECK(perfect_matching(2, edges_between({{0, 1}, {0, 1}, {0, 1}})).size() == 3);
  // A star of three edges: only one of its outer nodes can be matched.
  CHECK(perfect_matching(4, edges_between({{0, 1}, {0, 2}, {0, 3}})).empty());
}

TEST_CASE("refined cells are triangles around a centre from which the whole cell is visible") {
  Random random(2);
  const auto cells = make_cell_graph(square_with_hole(), 0.9, random);
  REQUIRE(cells);
  const RefinedGraph graph = refine(*cells);
  REQUIRE(graph.node_count() == cells->node_count() + cells->face_count());
  double covered = 0;
  for (const FaceIndex f : graph.face_start.indices()) {
    const HalfEdgeIndex start = graph.face_start[f];
    REQUIRE(graph.next(graph.next(graph.next(start))) == start);
    const double piece = signed_area(graph.outline(f));
    REQUIRE(piece > 0);
    covered += piece;
  }
  CHECK(covered == Approx(area(square_with_hole())).epsilon(1e-9));
}

TEST_CASE("random domains: the graph's invariants hold") {
  Random random(21);
  for (int k = 0; k < 60; ++k) {
    const Polygon island = random_island(random, 8, 5);
    const Region inner = offset(offset({island}, -0.2, 0.01), 0.15, 0.01);
    if (inner.empty()) continue;
    if (const auto graph = make_cell_graph(inner.front(), 0.9, random))
      check_cell_graph(*graph, inner.front());
    else
      REQUIRE(area(inner.front()) < 3);
  }
}
