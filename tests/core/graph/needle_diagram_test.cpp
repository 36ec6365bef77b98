#include "core/graph/needle_diagram.hpp"

#include <catch2/catch.hpp>

#include "core/graph/cell_graph.hpp"
#include "tests/core/support/cell_graph_check.hpp"
#include "tests/core/support/shapes.hpp"

using namespace unicursal::core;
using namespace unicursal::core::test;

namespace {

/// 120 needles in random directions, a unit apart, that do not meet.
std::vector<Segment> scattered_needles(Random& random, double longest) {
  std::vector<Segment> needles;
  for (int row = 0; row < 12; ++row) {
    for (int column = 0; column < 10; ++column) {
      const Vec2 seed(column + row % 2 * 0.5 + random.uniform(-0.1, 0.1),
                      0.87 * row + random.uniform(-0.1, 0.1));
      const double turn = random.uniform(0, 3.2), half = longest / 2 * random.uniform();
      const Vec2 u(half * std::cos(turn), half * std::sin(turn));
      needles.push_back({seed - u, seed + u});
    }
  }
  return needles;
}

double distance(const Segment& needle, const Vec2& point) {
  return distance_to_segment(point, needle.a, needle.b);
}

/// Sites on a grid of unit squares, shaken so that no four lie on a circle; far ones keep away.
std::vector<Vec2> shaken_grid(int side) {
  Random random(3);
  std::vector<Vec2> sites;
  for (int row = 0; row < side; ++row) {
    for (int column = 0; column < side; ++column)
      sites.emplace_back(column + random.uniform(-0.2, 0.2), row + random.uniform(-0.2, 0.2));
  }
  return sites;
}

}  // namespace

TEST_CASE("where three cells of needles meet, their needles are equally far away and no other is nearer") {
  Random random(7);
  const std::vector<Segment> needles = scattered_needles(random, 0.55);
  const Box box{{1, 1}, {8.5, 8.5}};
  const auto diagram = needle_diagram(needles, box);
  REQUIRE(diagram);
  int looked_at = 0;
  for (const VoronoiVertexIndex v : diagram->vertices.indices()) {
    const VoronoiVertex& vertex = diagram->vertices[v];
    const Vec2& p = vertex.position;
    if ((p - p.cwiseMax(box.min).cwiseMin(box.max)).norm() > 0) continue;
    double nearest = 1e9;
    for (const Segment& needle : needles) nearest = std::min(nearest, distance(needle, p));
    for (const VoronoiEdgeIndex e : vertex.edges) {
      const VoronoiEdge& edge = diagram->edges[e];
      REQUIRE((edge.from == v || edge.to == v));
      for (const CellIndex cell : {edge.left, edge.right})
        REQUIRE(distance(needles[cell.number()], p) < nearest + 0.02);
    }
    ++looked_at;
  }
  CHECK(looked_at > 90);
}

TEST_CASE("the needle on an edge's left lies to its left") {
  Random random(8);
  const std::vector<Segment> needles = scattered_needles(random, 0.4);
  const auto diagram = needle_diagram(needles, {{0, 0}, {10, 10}});
  REQUIRE(diagram);
  int looked_at = 0;
  for (const VoronoiEdge& edge : diagram->edges) {
    const std::size_t known = needles.size();
    if (edge.left.number() >= known || edge.right.number() >= known) continue;
    const Vec2& p = diagram->vertices[edge.from].position;
    const Vec2& q = diagram->vertices[edge.to].position;
    const auto middle = [&](CellIndex cell) {
      const Segment& needle = needles[cell.number()];
      return Vec2((needle.a + needle.b) / 2);
    };
    REQUIRE(cross(q - p, middle(edge.left) - middle(edge.right)) > 0);
    ++looked_at;
  }
  CHECK(looked_at > 200);
}

TEST_CASE("needles without length are points") {
  Random random(9);
  std::vector<Segment> needles = scattered_needles(random, 0);
  std::vector<Vec2> points;
  for (Segment& needle : needles) points.push_back(needle.a);
  const Box box{{0, 0}, {10, 10}};
  const auto diagram = needle_diagram(needles, box);
  REQUIRE(diagram);
  const Voronoi plain = voronoi(points, box);
  REQUIRE(diagram->vertices.size() == plain.vertices.size());
  REQUIRE(diagram->edges.size() == plain.edges.size());
  for (const VoronoiVertexIndex v : plain.vertices.indices())
    REQUIRE(diagram->vertices[v].position == plain.vertices[v].position);
}

TEST_CASE("of two needles in the same place only one gets a cell") {
  const std::vector<Segment> needles{
      {{1, 1}, {1, 1}}, {{3, 1}, {3, 1}}, {{3, 1}, {3, 1}}, {{2, 3}, {2, 3.5}}};
  const auto diagram = needle_diagram(needles, {{0, 0}, {4, 4}});
  REQUIRE(diagram);
  std::vector<std::size_t> untouched;
  const auto graph = clip_to_domain(*diagram, rectangle(4, 4), untouched);
  REQUIRE(graph);
  CHECK(graph->face_count() == 3);
}

TEST_CASE("a cell between two others keeps the bends that hold its sides apart") {
  // Group 0 is the middle one of 7 × 7 sites; the sites on its left form group 1, those on its right group 2.
  Per<CellIndex, CellIndex> group;
  for (int k = 0; k < 49; ++k)
    group.push_back(CellIndex(k == 24 ? 0 : k % 7 < 3 || (k % 7 == 3 && k < 24) ? 1 : 2));
  const std::vector<Vec2> sites = shaken_grid(7);
  auto diagram = merged(voronoi(sites, {{0, 0}, {6, 6}}), group);
  REQUIRE(diagram);
  straighten(*diagram, 3);
  std::vector<const VoronoiEdge*> sides;
  for (const VoronoiEdge& edge : diagram->edges) {
    if (edge.left == CellIndex(0) || edge.right == CellIndex(0)) sides.push_back(&edge);
  }
  REQUIRE(sides.size() == 2);
  CHECK(sides[0]->via.size() + sides[1]->via.size() >= 1);
  std::vector<std::size_t> untouched;
  const Polygon domain{{{-0.4, -0.4}, {6.4, -0.4}, {6.4, 6.4}, {-0.4, 6.4}}, {}};
  const auto graph = clip_to_domain(*diagram, domain, untouched);
  REQUIRE(graph);
  CHECK(graph->face_count() == 3);
  check_cell_graph(*graph, domain);
}

TEST_CASE("there is no diagram if a cell surrounds another") {
  Per<CellIndex, CellIndex> group(49, CellIndex(1));
  group[CellIndex(24)] = CellIndex(0);
  CHECK_FALSE(merged(voronoi(shaken_grid(7), {{0, 0}, {6, 6}}), group));
}

TEST_CASE("straightening removes all bends that are not needed") {
  Random random(11);
  const std::vector<Segment> needles = scattered_needles(random, 0.5);
  const auto diagram = needle_diagram(needles, {{0, 0}, {10, 10}});
  REQUIRE(diagram);
  for (const VoronoiEdge& edge : diagram->edges) CHECK(edge.via.empty());
}

TEST_CASE("bent edges are clipped by the domain like straight ones") {
  // Groups of 2 × 2 sites, not straightened: chains with bends, which cross the border of a narrow band.
  Per<CellIndex, CellIndex> group;
  for (std::size_t k = 0; k < 144; ++k) group.push_back(CellIndex(k / 24 * 6 + k % 12 / 2));
  const auto diagram = merged(voronoi(shaken_grid(12), {{0, 0}, {11, 11}}), group);
  REQUIRE(diagram);
  const double height = GENERATE(0.6, 1.4, 5.0);
  const Polygon band{{{0.3, 3}, {10.8, 3.3}, {10.8, 3.3 + height}, {0.3, 3 + height}}, {}};
  std::vector<std::size_t> untouched;
  const auto graph = clip_to_domain(*diagram, band, untouched);
  REQUIRE(graph);
  check_cell_graph(*graph, band);
}
