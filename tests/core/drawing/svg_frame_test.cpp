#include "core/drawing/svg_frame.hpp"

#include <catch2/catch.hpp>

#include "core/drawing/svg_transform.hpp"
#include "core/text/malformed.hpp"

using namespace unicursal::core;

namespace {

Vec2 placed(const PageAttributes& attributes, const Vec2& user) {
  Warnings warnings;
  return page(attributes, warnings).to_part * user;
}

void check_point(const Vec2& p, double x, double y) {
  CHECK(p.x() == Approx(x).margin(1e-9));
  CHECK(p.y() == Approx(y).margin(1e-9));
}

}  // namespace

TEST_CASE("an inch is an inch in every unit") {
  const auto text =
      GENERATE("96", "96px", "25.4mm", "2.54cm", "101.6Q", "1in", "72pt", "6pc", " 1in ", "50%");
  CAPTURE(text);
  CHECK(length(text, 192) == Approx(96));
}

TEST_CASE("relative lengths refer to the font and to the viewport") {
  const LengthFrame frame{200, 10, {300, 400}};
  CHECK(length("2em", frame) == Approx(20));
  CHECK(length("2ex", frame) == Approx(10));
  CHECK(length("2rem", frame) == Approx(32));
  CHECK(length("5vw", frame) == Approx(15));
  CHECK(length("5vmax", frame) == Approx(20));
  CHECK(length("5%", frame) == Approx(10));
}

TEST_CASE("text that is not a length is refused") {
  const auto text = GENERATE("", "mm", "1 mm", "1fm", "1mmm", "1%%", "1mm2");
  CAPTURE(text);
  CHECK_THROWS_AS(length(text, 1), Malformed);
}

TEST_CASE("the page's width and height give the scale, and y points up") {
  check_point(placed({"100mm", "50mm", "0 0 200 100", ""}, {0, 0}), 0, 50);
  check_point(placed({"100mm", "50mm", "0 0 200 100", ""}, {200, 100}), 100, 0);
  check_point(placed({"1in", "1in", "", ""}, {96, 96}), 25.4, 0);
  check_point(placed({"100mm", "50mm", "-100 -50 200 100", ""}, {0, 0}), 50, 25);
}

TEST_CASE("a missing side follows from the viewBox") {
  check_point(placed({"100mm", "", "0 0 200 100", ""}, {200, 0}), 100, 50);
  check_point(placed({"", "50mm", "0 0 200 100", ""}, {200, 0}), 100, 50);
}

TEST_CASE("without any size a unit is a pixel, and the user is warned") {
  Warnings warnings;
  const Page p = page({"", "100%", "0 0 96 96", ""}, warnings);
  check_point(p.to_part * Vec2(96, 96), 25.4, 0);
  REQUIRE(warnings.sentences().size() == 1);
  CHECK(warnings.sentences().front().find("1/96 inch") != std::string::npos);
}

TEST_CASE("proportions of page and viewBox that differ") {
  const auto top_left = [](std::string_view how) {
    return placed({"200mm", "100mm", "0 0 10 10", how}, {0, 0});
  };
  check_point(top_left(""), 50, 100);
  check_point(top_left("xMinYMid meet"), 0, 100);
  check_point(top_left("xMaxYMax"), 100, 100);
  check_point(top_left("xMidYMid slice"), 0, 150);
  check_point(top_left("xMidYMin slice"), 0, 100);
  check_point(top_left("none"), 0, 100);
  check_point(placed({"200mm", "100mm", "0 0 10 10", "none"}, {10, 10}), 200, 0);
}

TEST_CASE("pages without size are refused") {
  CHECK_THROWS_AS(placed({"0mm", "1mm", "", ""}, {0, 0}), Malformed);
  CHECK_THROWS_AS(placed({"-1mm", "1mm", "", ""}, {0, 0}), Malformed);
  CHECK_THROWS_AS(placed({"1mm", "1mm", "0 0 0 1", ""}, {0, 0}), Malformed);
  CHECK_THROWS_AS(placed({"1mm", "1mm", "0 0 1", ""}, {0, 0}), Malformed);
}

TEST_CASE("each transform moves a point as the standard says") {
  const Vec2 p(3, 1);
  check_point(transform("translate(10,20)") * p, 13, 21);
  check_point(transform("translate(10)") * p, 13, 1);
  check_point(transform("scale(2)") * p, 6, 2);
  check_point(transform("scale(2 -1)") * p, 6, -1);
  check_point(transform("rotate(90)") * p, -1, 3);
  check_point(transform("rotate(90, 3, 0)") * p, 2, 0);
  check_point(transform("skewX(45)") * p, 4, 1);
  check_point(transform("skewY(45)") * p, 3, 4);
  check_point(transform("matrix(1 2 3 4 5 6)") * p, 1 * 3 + 3 * 1 + 5, 2 * 3 + 4 * 1 + 6);
}

TEST_CASE("transforms of CSS have units and names of their own") {
  const Vec2 p(3, 1);
  const TransformFrame frame{{{0, 0}, {200, 100}}, 16};
  check_point(transform("translateX(1in)") * p, 99, 1);
  check_point(transform("translate(10%, 10%)", frame) * p, 23, 11);
  check_point(transform("rotate(0.25turn)") * p, -1, 3);
  check_point(transform("rotate(100grad)") * p, -1, 3);
  check_point(transform("scaleY(300%)") * p, 3, 3);
  check_point(transform("skew(45deg)") * p, 4, 1);
  check_point(transform("none") * p, 3, 1);
  check_point(transform_origin("right 10px", frame), 200, 10);
  check_point(transform_origin("50%", frame), 100, 50);
  check_point(transform_origin("top", frame), 100, 0);
  CHECK_THROWS_AS(transform_origin("corner", frame), Malformed);
  CHECK_THROWS_AS(transform("rotate(1km)"), Malformed);
}

TEST_CASE("in a list the last transform acts first") {
  check_point(transform("translate(10 0) scale(2), rotate(90)") * Vec2(1, 0), 10, 2);
  check_point(transform("") * Vec2(1, 2), 1, 2);
}

TEST_CASE("damaged transforms are refused") {
  const auto text = GENERATE("translate", "translate(", "translate(1", "translate()", "spin(3)",
                             "matrix(1 2 3)", "rotate(1,2)", "(1)", "scale(2))");
  CAPTURE(text);
  CHECK_THROWS_AS(transform(text), Malformed);
}
