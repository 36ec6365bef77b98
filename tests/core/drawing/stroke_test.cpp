#include "core/drawing/stroke.hpp"

#include <catch2/catch.hpp>
#include <numbers>
#include <random>

#include "core/drawing/svg_path.hpp"
#include "core/geometry/region.hpp"
#include "core/text/malformed.hpp"

using namespace unicursal::core;

namespace {

constexpr double pi = std::numbers::pi;

double area_of(std::string_view path, const StrokeStyle& style) {
  Outline outline(Eigen::Affine2d::Identity());
  draw_path(path, outline);
  const auto line = style.dashes.empty() ? outline.subpaths() : dashed(outline.subpaths(), style);
  return area(enclosed(stroke_rings(line, style), FillRule::non_zero));
}

StrokeStyle pen(double width, Cap cap = Cap::butt, Join join = Join::miter) {
  StrokeStyle style;
  style.width = width;
  style.cap = cap;
  style.join = join;
  return style;
}

}  // namespace

TEST_CASE("caps lengthen an open line") {
  CHECK(area_of("M0 0H10", pen(2)) == Approx(20));
  CHECK(area_of("M0 0H10", pen(2, Cap::square)) == Approx(24));
  CHECK(area_of("M0 0H10", pen(2, Cap::round)) == Approx(20 + pi).margin(0.1));
  CHECK(area_of("M0 0H10", pen(0)) == 0);
}

TEST_CASE("joins fill the outer side of a corner") {
  CHECK(area_of("M0 0H10V10", pen(2)) == Approx(40));
  CHECK(area_of("M0 0H10V10", pen(2, Cap::butt, Join::bevel)) == Approx(39.5));
  CHECK(area_of("M0 0H10V10", pen(2, Cap::butt, Join::round)) == Approx(39 + pi / 4).margin(0.02));
  // A right angle's miter is 1.41 times as long as the stroke is wide.
  StrokeStyle limited = pen(2);
  limited.miter_limit = 1.4;
  CHECK(area_of("M0 0H10V10", limited) == Approx(39.5));
  limited.miter_limit = 1.42;
  CHECK(area_of("M0 0H10V-10", limited) == Approx(40));
}

TEST_CASE("closed lines have no caps, and a join where they close") {
  CHECK(area_of("M0 0H10V10H0Z", pen(2)) == Approx(144 - 64));
  CHECK(area_of("M0 0H10V10H0V0Z", pen(2)) == Approx(144 - 64));
  CHECK(area_of("M0 0V10H10V0Z", pen(2, Cap::square)) == Approx(144 - 64));
  CHECK(area_of("M0 0H10V10H0Z", pen(30)) == Approx(40 * 40));  // the hole is painted over
  CHECK(area_of("M0 0H10Z", pen(2, Cap::butt, Join::bevel)) == Approx(20));
}

TEST_CASE("a stroke along a circle is a ring, also when it is wider than the circle") {
  const char* const circle = "M10 0A10 10 0 0 1-10 0A10 10 0 0 1 10 0Z";
  CHECK(area_of(circle, pen(4)) == Approx(pi * (144 - 64)).epsilon(0.002));
  CHECK(area_of(circle, pen(24)) == Approx(pi * 22 * 22).epsilon(0.002));
}

TEST_CASE("overlapping strokes count once") {
  CHECK(area_of("M-5 0H5M0-5V5", pen(2)) == Approx(36));
  CHECK(area_of("M0 0H10H0", pen(2)) == Approx(20));
}

TEST_CASE("lines without length are drawn by their caps") {
  CHECK(area_of("M5 5H5", pen(2, Cap::round)) == Approx(pi).margin(0.1));
  CHECK(area_of("M5 5H5", pen(2, Cap::square)) == Approx(4));
  CHECK(area_of("M5 5H5", pen(2)) == 0);
}

TEST_CASE("dashes cut a line by its length") {
  StrokeStyle style = pen(2);
  style.dashes = {3, 1};
  CHECK(area_of("M0 0H10", style) == Approx(2 * (3 + 3 + 2)));
  style.dash_offset = 2;
  CHECK(area_of("M0 0H10", style) == Approx(2 * (1 + 3 + 3)));
  style.dash_offset = -1;
  CHECK(area_of("M0 0H10", style) == Approx(2 * (3 + 3 + 1)));
  style.dash_offset = 0;
  style.dashes = {2};  // an odd list counts twice
  CHECK(area_of("M0 0H10", style) == Approx(2 * 6));
  style.dashes = {2, 3};  // across corners
  CHECK(area_of("M0 0H11V9", style) == Approx(2 * 2 * 4));
  style.dashes = {0, 5};
  style.cap = Cap::round;
  CHECK(area_of("M0 0H14", style) == Approx(3 * pi).margin(0.2));
}

TEST_CASE("the dashes at both ends of a closed line are one") {
  StrokeStyle style = pen(2, Cap::square);
  style.dashes = {4, 6};
  style.dash_offset = 2;
  // Ten units of each side's middle stay empty: dashes lie across the corners, joined there.
  CHECK(area_of("M0 0H10V10H0Z", style) == Approx(4 * (2 * (2 * 2) + 2 * 2)));
}

TEST_CASE("strokes of random lines are as large as those of their pieces together") {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> at(0, 50);
  for (int round = 0; round < 50; ++round) {
    std::string path = "M" + std::to_string(at(random)) + " " + std::to_string(at(random));
    Region pieces;
    Vec2 from(0, 0);
    const StrokeStyle style = pen(3, Cap::round, Join::round);
    Subpath line;
    for (int i = 0; i < 6; ++i) {
      const Vec2 p(at(random), at(random));
      if (i > 0)
        pieces = unite(pieces,
                       enclosed(stroke_rings({{{from, p}, {true, true}, false}}, style), FillRule::non_zero));
      line.points.push_back(p);
      line.corner.push_back(true);
      from = p;
    }
    const Region whole = enclosed(stroke_rings({line}, style), FillRule::non_zero);
    CHECK(area(subtract(whole, pieces)) < 0.2);
    CHECK(area(subtract(pieces, whole)) < 0.2);
  }
}

TEST_CASE("a pen as wide as a street does not round a hundred thousand corners") {
  std::string path = "M0 0";
  for (int i = 0; i < 100000; ++i) path += i % 2 == 0 ? "h9" : "v9";
  CHECK_THROWS_AS(area_of(path, pen(5e4, Cap::butt, Join::round)), Malformed);
  path = "M0 0";
  for (int i = 0; i < 2000; ++i) path += "C9e4 0 -9e4 9e4 0 0";
  Outline outline(Eigen::Affine2d::Identity());
  CHECK_THROWS_AS(draw_path(path, outline), TooFar);
}

TEST_CASE("a million dashes are refused") {
  StrokeStyle style = pen(1);
  style.dashes = {1e-4, 1e-4};
  CHECK_THROWS_AS(area_of("M0 0H1000", style), Malformed);
}
