#include "core/graph/needles.hpp"

#include <catch2/catch.hpp>

#include <numbers>

#include "core/field/make_direction_field.hpp"
#include "core/graph/cell_graph.hpp"
#include "core/graph/seeds.hpp"
#include "tests/core/support/cell_graph_check.hpp"
#include "tests/core/support/shapes.hpp"

using namespace unicursal::core;
using namespace unicursal::core::test;

namespace {

constexpr double pi = std::numbers::pi;

Zone asking(PatternKind kind, double angle = 0) {
  Zone zone;
  zone.pattern.kind = kind;
  zone.pattern.angle = angle;
  return zone;
}

DirectionField uniform_field(const Polygon& domain, double angle) {
  return make_direction_field(whole(domain), {asking(PatternKind::angle, angle)}, 0.2);
}

/// Asks for directions only on the left half of a 12 × 12 square.
DirectionField half_field(double angle) {
  const Polygon left{{{0, 0}, {6, 0}, {6, 12}, {0, 12}}, {}}, right{{{6, 0}, {12, 0}, {12, 12}, {6, 12}}, {}};
  const Island island{rectangle(12, 12), {{0, {left}}, {1, {right}}}};
  return make_direction_field(island, {asking(PatternKind::angle, angle), asking(PatternKind::isotropic)},
                              0.2);
}

double length(const Segment& needle) {
  return (needle.b - needle.a).norm();
}

/// Mean squared angle between the inner edges and the field, weighted by length, rad².
double misalignment(const CellGraph& graph, const DirectionField& field) {
  double total = 0, squared = 0;
  for (const EdgeIndex e : graph.edges()) {
    const HalfEdgeIndex h = PlanarGraph::forward(e);
    if (graph.face(h) == outside || graph.face(PlanarGraph::twin(h)) == outside) continue;
    const Vec2 &a = graph.position[graph.origin(h)], &b = graph.position[graph.target(h)];
    const Vec2 asked = field.at((a + b) / 2), u = b - a;
    if (asked.norm() < 0.5) continue;
    const double off = std::remainder(std::atan2(u.y(), u.x()) - direction(asked), pi);
    total += u.norm();
    squared += off * off * u.norm();
  }
  return squared / total;
}

}  // namespace

TEST_CASE("a needle has the field's direction and the paper's length") {
  const Polygon domain = rectangle(12, 12);
  const double angle = GENERATE(-1.2, 0.0, 0.5, pi / 2);
  Random random(1);
  const std::vector<Vec2> seeds = place_seeds(domain, 1.0, random);
  NeedleTessellation tessellation(domain, uniform_field(domain, angle), 1.0, 1);
  const double expected = std::sqrt(144 / (pi * static_cast<double>(seeds.size())));
  const Vec2 u(std::cos(angle), std::sin(angle));
  int inner = 0;
  const std::vector<Segment> needles = tessellation.needles(seeds);
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    const Segment& needle = needles[i];
    CHECK(std::abs(cross(needle.b - needle.a, u)) < 1e-6);
    CHECK(((needle.a + needle.b) / 2 - seeds[i]).norm() < 1e-9);
    if (distance_to_border(domain, seeds[i]) < 0.6) continue;
    CHECK(length(needle) == Approx(expected).epsilon(1e-5));
    ++inner;
  }
  CHECK(inner > 80);
}

TEST_CASE("needles end inside the cell of their seed and inside the domain") {
  const Polygon domain = square_with_hole();
  Random random(2);
  const std::vector<Vec2> seeds = place_seeds(domain, 0.8, random);
  NeedleTessellation tessellation(domain, uniform_field(domain, 0.3), 0.8, 4);
  double longest = 0;
  const std::vector<Segment> needles = tessellation.needles(seeds);
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    longest = std::max(longest, length(needles[i]));
    for (const Vec2& end : {needles[i].a, needles[i].b}) {
      REQUIRE(contains(domain, end));
      for (const Vec2& other : seeds) REQUIRE((end - seeds[i]).norm() <= (end - other).norm());
    }
  }
  CHECK(longest > 0.7);  // needles end at the cell's border, not at the paper's length of 0.42
}

TEST_CASE("where no direction is asked, needles are points") {
  Random random(3);
  const std::vector<Vec2> seeds = place_seeds(rectangle(12, 12), 1.0, random);
  NeedleTessellation tessellation(rectangle(12, 12), half_field(0.4), 1.0, 1);
  for (const Segment& needle : tessellation.needles(seeds)) {
    const Vec2 middle = (needle.a + needle.b) / 2;
    if (middle.x() > 6.8) CHECK(length(needle) == 0);
    if (middle.x() < 5.2) CHECK(length(needle) > 0.3);
  }
}

TEST_CASE("directions that cancel each other within a cell make a shorter needle") {
  // Directions along x and along y are opposite vectors in doubled angle.
  const Polygon left{{{0, 0}, {6, 0}, {6, 12}, {0, 12}}, {}}, right{{{6, 0}, {12, 0}, {12, 12}, {6, 12}}, {}};
  const Island island{rectangle(12, 12), {{0, {left}}, {1, {right}}}};
  const DirectionField field =
      make_direction_field(island, {asking(PatternKind::angle, 0), asking(PatternKind::angle, pi / 2)}, 0.1);
  NeedleTessellation tessellation(rectangle(12, 12), field, 2.0, 1);
  // Cells of 2 × 2 mm: the middle column lies half in each zone, its left neighbour wholly in one.
  std::vector<Vec2> seeds;
  for (double x = 2; x < 12; x += 2) {
    for (double y = 1; y < 12; y += 2) seeds.emplace_back(x, y);
  }
  const std::vector<Segment> needles = tessellation.needles(seeds);
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    if (seeds[i].x() == 6)
      CHECK(length(needles[i]) < 0.3);  // 1.24 without; samples at equal distances go to one side
    if (seeds[i].x() == 4) CHECK(length(needles[i]) == Approx(std::sqrt(144 / (pi * 30))).epsilon(0.01));
  }
}

TEST_CASE("the coverage of needles is an integral, and its gradient is one") {
  const Polygon domain = rectangle(6, 6);
  Random random(4);
  const std::vector<Vec2> seeds = place_seeds(domain, 1.3, random);
  NeedleTessellation tessellation(domain, uniform_field(domain, 0.7), 1.3, 1);
  const std::vector<Segment> needles = tessellation.needles(seeds);
  std::vector<Vec2> gradient, unused;
  const double value = tessellation.coverage(needles, gradient);

  double integral = 0;
  constexpr int fine = 200;
  for (int k = 0; k < fine * fine; ++k) {
    const Vec2 p = 6.0 / fine * Vec2(k % fine + 0.5, k / fine + 0.5);
    double nearest = 1e9;
    for (const Segment& n : needles) nearest = std::min(nearest, distance_to_segment(p, n.a, n.b));
    integral += nearest * nearest * 36 / (fine * fine);
  }
  CHECK(value == Approx(integral).epsilon(0.02));  // the lattice has 8 squares per d

  constexpr double h = 1e-5;
  for (std::size_t i = 0; i < needles.size(); ++i) {
    for (const Vec2& way : {Vec2(h, 0), Vec2(0, h)}) {
      auto ahead = needles, behind = needles;
      ahead[i] = {needles[i].a + way, needles[i].b + way};
      behind[i] = {needles[i].a - way, needles[i].b - way};
      const double slope =
          (tessellation.coverage(ahead, unused) - tessellation.coverage(behind, unused)) / 2 / h;
      REQUIRE(slope == Approx(gradient[i].dot(way) / h).margin(5e-3));
    }
  }
}

TEST_CASE(
    "relaxation lowers the coverage of points below that of Lloyd's method, and the coverage of needles") {
  const Polygon domain = square_with_hole();
  const double angle = GENERATE(0.0, 0.9);
  Random random(6);
  std::vector<Vec2> seeds = place_seeds(domain, 0.9, random);
  const bool points = GENERATE(true, false);
  NeedleTessellation tessellation(domain, points ? DirectionField() : uniform_field(domain, angle), 0.9, 1);
  std::vector<Vec2> unused;
  const double before = tessellation.coverage(tessellation.needles(seeds), unused);
  tessellation.relax(seeds, 30);
  CHECK(tessellation.coverage(tessellation.needles(seeds), unused) < (points ? 0.998 : 0.97) * before);
  for (const Vec2& seed : seeds) REQUIRE(contains(domain, seed));
}

TEST_CASE("edges of a graph of needles follow the field") {
  const Polygon domain{circle({0, 0}, 10, 100), {}};
  const DirectionField field = make_direction_field(whole(domain), {asking(PatternKind::parallel)}, 0.2);
  Random random(1);
  const auto points = make_cell_graph(domain, 1.0, random);
  GraphOptions options;
  options.seeds.d = 1.0;
  options.field = &field;
  const auto needles = make_cell_graph(domain, options, random);
  REQUIRE(points);
  REQUIRE(needles);
  check_cell_graph(*needles, domain);
  CHECK(misalignment(*points, field) > 0.7);  // π²/12 = 0.82 for all directions alike
  CHECK(misalignment(*needles, field) < 0.55);
}

TEST_CASE("an empty field does not change the graph") {
  const DirectionField nothing;
  GraphOptions options;
  options.field = &nothing;
  Random first(1), second(1);
  const auto with = make_cell_graph(square_with_hole(), options, first);
  const auto without = make_cell_graph(square_with_hole(), 1.0, second);
  REQUIRE(with);
  REQUIRE(without);
  CHECK(with->position == without->position);
}

namespace {

void check_random_domains(Random& random, int count) {
  for (int k = 0; k < count; ++k) {
    const Polygon island = random_island(random, 8, 5);
    const Region inner = offset(offset({island}, -0.2, 0.01), 0.15, 0.01);
    if (inner.empty()) continue;
    const PatternKind kind = k % 2 == 0 ? PatternKind::parallel : PatternKind::angle;
    GraphOptions options;
    options.seeds = {0.9, {}, 1 + k % 4 * 0.4};
    const DirectionField field = make_direction_field(whole(inner.front()), {asking(kind, 0.1 * k)}, 0.2);
    options.field = &field;
    options.needle_length = 1 + k % 3;
    CAPTURE(k, area(inner.front()));
    if (const auto graph = make_cell_graph(inner.front(), options, random))
      check_cell_graph(*graph, inner.front());
    else
      REQUIRE(area(inner.front()) < 3);
  }
}

}  // namespace

TEST_CASE("random domains with needles: the graph's invariants hold") {
  Random random(22);
  check_random_domains(random, 20);
}

TEST_CASE("thousands of random domains with needles", "[long]") {
  Random random(23);
  check_random_domains(random, 3000);
}
