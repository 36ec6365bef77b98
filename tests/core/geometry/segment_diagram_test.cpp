#include "core/geometry/segment_diagram.hpp"

#include <catch2/catch.hpp>

#include "core/curve/clearance.hpp"
#include "core/curve/resample.hpp"
#include "core/geometry/lattice_owners.hpp"
#include "tests/core/support/shapes.hpp"

using namespace unicursal::core;
using namespace unicursal::core::test;

namespace {

CellIntegrals total(const SegmentDiagram& diagram) {
  CellIntegrals sum;
  for (const auto* cells : {&diagram.points, &diagram.segments}) {
    for (const CellIntegrals& cell : *cells) sum.area += cell.area, sum.second_moment += cell.second_moment;
  }
  return sum;
}

/// A snake of `folds` strands with spacing `w`.
Ring snake(double length, double w, int folds) {
  Ring ring;
  for (int k = 0; k < folds; ++k) {
    const double x = (k + 0.5) * w;
    const Vec2 low(x, k == 0 ? w / 2 : 1.5 * w), high(x, length - w / 2);
    if (k % 2 == 0)
      ring.insert(ring.end(), {low, high});
    else
      ring.insert(ring.end(), {high, low});
  }
  ring.push_back({(folds - 0.5) * w, w / 2});
  return ring;
}

}  // namespace

TEST_CASE("a concentric square's cells have their closed-form areas and moments") {
  // A square path of side 6 in a square of side 10: outside strips of width 2, inside triangles of height 3.
  const Ring path{{2, 2}, {8, 2}, {8, 8}, {2, 8}};
  const SegmentDiagram diagram = segment_diagram(path, rectangle(10, 10));
  for (int i = 0; i < 4; ++i) {
    const auto k = static_cast<std::size_t>(i);
    CHECK(diagram.points[k].area == Approx(4).epsilon(1e-12));
    CHECK(diagram.points[k].second_moment == Approx(2 * 2 * 8.0 / 3).epsilon(1e-12));
    CHECK(diagram.segments[k].area == Approx(12 + 9).epsilon(1e-12));
    CHECK(diagram.segments[k].second_moment == Approx(6 * 8.0 / 3 + 2 * 81.0 / 12).epsilon(1e-12));
  }
}

TEST_CASE("for parallel strands of spacing w, E_CVT ÷ (A·w²) is near 1/12") {
  const double w = 0.5;
  const int folds = 40;
  const Polygon island = rectangle(folds * w, 60);
  const Ring path = snake(60, w, folds);
  const CellIntegrals sum = total(segment_diagram(path, island));
  CHECK(sum.area == Approx(area(island)).epsilon(1e-12));
  CHECK(sum.second_moment / (area(island) * w * w) == Approx(1.0 / 12).epsilon(0.02));
}

TEST_CASE("cells add up to the island and agree with a fine lattice") {
  // A wavy ring around the hole: it has parabolas, arcs that the border cuts, and cells on both sides of the
  // hole.
  Ring path;
  for (int k = 0; k < 150; ++k) {
    const double turn = 2 * std::numbers::pi * k / 150;
    path.push_back(Vec2(6, 6) + (4.4 + 0.8 * std::sin(9 * turn)) * Vec2(std::cos(turn), std::sin(turn)));
  }
  const Polygon island = square_with_hole();
  const SegmentDiagram diagram = segment_diagram(path, island);
  const CellIntegrals sum = total(diagram);
  CHECK(sum.area == Approx(area(island)).epsilon(1e-12));

  std::vector<Segment> segments;
  for (std::size_t i = 0; i < path.size(); ++i) segments.push_back({path[i], path[(i + 1) % path.size()]});
  const Lattice lattice = sample(island, 0.01);
  LatticeOwners owners(lattice);
  owners.assign(segments);
  std::vector<double> areas(path.size(), 0);
  double moment = 0;
  for (std::size_t k = 0; k < lattice.size(); ++k) {
    if (lattice.weight(k) <= 0) continue;
    areas[static_cast<std::size_t>(owners.owner(k))] += lattice.weight(k);
    moment += lattice.weight(k) * owners.distance2(k);
  }
  CHECK(sum.second_moment == Approx(moment).epsilon(1e-3));
  for (std::size_t i = 0; i < path.size(); ++i) {
    // Samples of a vertex's cell may count for either neighbour, so the cells of both vertices bound the
    // difference.
    const double own = diagram.segments[i].area;
    const double ends = diagram.points[i].area + diagram.points[(i + 1) % path.size()].area;
    REQUIRE(areas[i] > own - 0.01);
    REQUIRE(areas[i] < own + ends + 0.01);
  }
}

TEST_CASE("a diagram made in pieces equals that of the whole curve, with any number of threads") {
  // There are enough vertices for several pieces, and the hole makes them non-convex.
  Ring path;
  constexpr int count = 7000;
  for (int k = 0; k < count; ++k) {
    const double turn = 2 * std::numbers::pi * k / count;
    path.push_back(Vec2(6, 6) + (4.4 + 0.8 * std::sin(40 * turn)) * Vec2(std::cos(turn), std::sin(turn)));
  }
  const Polygon island = square_with_hole();
  Workers two(2);
  const SegmentDiagram diagram = segment_diagram(path, island), shared = segment_diagram(path, island, &two);
  const CellIntegrals sum = total(diagram);
  CHECK(sum.area == Approx(area(island)).epsilon(1e-12));

  // The curve and the island are the same after a quarter turn, but the pieces are not.
  for (std::size_t i = 0; i < path.size(); ++i) {
    const std::size_t turned = (i + count / 4) % count;
    REQUIRE(diagram.segments[i].area == Approx(diagram.segments[turned].area).margin(1e-9));
    REQUIRE(diagram.points[i].second_moment == Approx(diagram.points[turned].second_moment).margin(1e-9));
    REQUIRE(shared.segments[i].area == diagram.segments[i].area);
    REQUIRE(shared.points[i].second_moment == diagram.points[i].second_moment);
  }
}

TEST_CASE("collinear and nearly collinear vertices do not change the areas") {
  const Ring plain{{2, 2}, {8, 2}, {8, 8}, {2, 8}};
  const Ring dense{{2, 2}, {4, 2}, {5, 2 + 1e-9}, {6, 2}, {8, 2}, {8, 8}, {5, 8}, {2, 8}};
  const CellIntegrals a = total(segment_diagram(plain, rectangle(10, 10)));
  const CellIntegrals b = total(segment_diagram(dense, rectangle(10, 10)));
  CHECK(b.area == Approx(a.area).epsilon(1e-10));
  CHECK(b.second_moment == Approx(a.second_moment).epsilon(1e-7));
}

TEST_CASE("cells add up to the area of a border that overlaps itself within rounding") {
  // A tail with its sides reversed, as clipping on a grid may leave it: its area is negative.
  const double width = GENERATE(1e-8, 1e-6, 1e-3, 0.1);
  const Polygon island{{{0, 0}, {10, 0}, {10, 5 + width}, {14, 5.1}, {10, 5 - width}, {10, 10}, {0, 10}}, {}};
  const SegmentDiagram diagram = segment_diagram({{2, 2}, {8, 2}, {8.5, 4.9}, {8, 8}, {2, 8}}, island);
  CHECK(total(diagram).area == Approx(area(island)).epsilon(1e-13));
  CHECK(area(island) < 100);
}

TEST_CASE("cells add up to the island however little neighbours turn and however short they are") {
  Random random(11);
  const Polygon island = square_with_hole();
  for (int round = 0; round < 60; ++round) {
    // A plain ring around the hole, and the same ring with vertices that hardly leave its sides.
    Ring plain, dense;
    for (int k = 0; k < 9; ++k) {
      const double turn = 2 * std::numbers::pi * k / 9;
      plain.push_back(Vec2(6, 6) + random.uniform(4.2, 5.4) * Vec2(std::cos(turn), std::sin(turn)));
    }
    const double largest = std::pow(10, random.uniform(-16, -3));
    for (std::size_t k = 0; k < plain.size(); ++k) {
      const Vec2 &a = plain[k], &b = plain[(k + 1) % plain.size()];
      dense.push_back(a);
      const std::size_t cuts = random.below(6);
      for (std::size_t c = 1; c <= cuts; ++c) {
        const double s = (static_cast<double>(c) - random.uniform(0, 0.999)) / static_cast<double>(cuts + 1);
        dense.push_back(a + s * (b - a) + random.uniform(-largest, largest) * perpendicular(b - a));
      }
    }
    CAPTURE(round, largest);
    const SegmentDiagram diagram = segment_diagram(dense, island);
    const CellIntegrals sum = total(diagram), whole = total(segment_diagram(plain, island));
    REQUIRE(sum.area == Approx(area(island)).epsilon(1e-12));
    REQUIRE(sum.second_moment == Approx(whole.second_moment).epsilon(1e-7 + 10 * largest));
    for (const auto* cells : {&diagram.points, &diagram.segments}) {
      for (const CellIntegrals& cell : *cells) REQUIRE(cell.area > -1e-7);
    }
  }
}

TEST_CASE(
    "cells add up to the island if all vertices lie on one grid, with borders along borders and many ties") {
  Random random(17);
  int checked = 0;
  for (int round = 0; round < 150; ++round) {
    std::vector<Ring> inner, outer;
    const auto add = [&](double x, double y, double width, double height) {
      inner.push_back({{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}});
      const double m = 1;
      outer.push_back(
          {{x - m, y - m}, {x + width + m, y - m}, {x + width + m, y + height + m}, {x - m, y + height + m}});
    };
    const auto number = [&](std::size_t below) { return static_cast<double>(1 + random.below(below)); };
    add(0, 0, 6, 6);
    for (std::size_t k = random.below(6); k > 0; --k)
      add(number(10) - 6, number(10) - 6, number(8), number(8));
    Curve curve{enclosed(inner, FillRule::non_zero).front().outer};
    const Region islands = enclosed(outer, FillRule::non_zero);
    if (self_intersections(curve) > 0 || islands.size() != 1) continue;
    while (random.below(2) == 0) curve = subdivided(curve);
    const Polygon island{islands.front().outer, {}};
    const SegmentDiagram diagram = segment_diagram(curve.vertices, island);
    CAPTURE(round, curve.size());
    REQUIRE(total(diagram).area == Approx(area(island)).epsilon(1e-12));
    for (const auto* cells : {&diagram.points, &diagram.segments}) {
      for (const CellIntegrals& cell : *cells) REQUIRE(cell.area > -1e-9);
    }
    ++checked;
  }
  CHECK(checked > 80);
}
