// Text becomes outlines of installed fonts; these tests use DejaVu Sans.
#include <catch2/catch.hpp>

#include "tests/core/drawing/drawing_support.hpp"

using namespace unicursal::core;
using Catch::Matchers::Contains;

namespace {

Box box(const std::string& text) {
  const auto shapes = read(drawing("<g font-family='DejaVu Sans' font-size='10'>" + text + "</g>")).shapes;
  std::vector<Polygon> all;
  for (const Shape& shape : shapes) all.insert(all.end(), shape.region.begin(), shape.region.end());
  REQUIRE(!all.empty());
  const Box found = bounds(all);
  return {{found.min.x(), 80 - found.max.y()}, {found.max.x(), 80 - found.min.y()}};
}

}  // namespace

TEST_CASE("letters stand on the base line, in their size") {
  // DejaVu Sans: capitals are 0.729 of the size high, the bar of an I is 0.098 to 0.197 of it.
  const Box letter = box("<text x='20' y='40'>I</text>");
  CHECK(letter.max.y() == Approx(40));
  CHECK(letter.size().y() == Approx(7.29).margin(0.01));
  CHECK(letter.min.x() == Approx(20.98).margin(0.01));
  CHECK(letter.size().x() == Approx(0.99).margin(0.01));
  CHECK(box("<text x='20' y='40' font-size='20'>I</text>").size().y() == Approx(14.58).margin(0.02));
}

TEST_CASE("holes of letters stay open") {
  const double ring = area_of("<text x='20' y='60' font-size='40' font-family='DejaVu Sans'>O</text>");
  CHECK(ring > 100);
  CHECK(ring < 0.5 * 40 * 0.787 * 40 * 0.76);
}

TEST_CASE("text is anchored, moved letter by letter, and its spaces are collapsed") {
  const double start = box("<text x='50' y='40'>IIII</text>").center().x();
  const double middle = box("<text x='50' y='40' text-anchor='middle'>IIII</text>").center().x();
  const double end = box("<text x='50' y='40' text-anchor='end'>IIII</text>").center().x();
  CHECK(middle == Approx(50).margin(0.01));
  CHECK(start - 50 == Approx(50 - end).margin(0.01));
  CHECK(box("<text x='20 60' y='40 50'>II</text>").max.x() == Approx(61.97).margin(0.02));
  CHECK(box("<text x='20' y='40'>I<tspan dx='10' dy='-5'>I</tspan></text>").size().y() ==
        Approx(12.29).margin(0.02));
  CHECK(box("<text x='20' y='40'>\n  I \t\n I  \n</text>").size().x() ==
        Approx(box("<text x='20' y='40'>I I</text>").size().x()));
  CHECK(box("<text x='20' y='40' xml:space='preserve'>I  I</text>").size().x() ==
        Approx(box("<text x='20' y='40'>I I</text>").size().x() + 3.18).margin(0.02));
  CHECK(box("<text x='20' y='40' letter-spacing='4'>II</text>").size().x() ==
        Approx(box("<text x='20' y='40'>II</text>").size().x() + 4).margin(0.01));
}

TEST_CASE("parts of a text have colours of their own") {
  const auto areas =
      seen_areas(read(drawing("<text font-family='DejaVu Sans' x='10' y='40' font-size='20'>I<tspan "
                              "fill='#f00'>I</tspan></text>"))
                     .shapes);
  REQUIRE(areas.size() == 2);
  CHECK(areas.at("#ff0000") == Approx(areas.at("#000000")).epsilon(0.001));
}

TEST_CASE("text is stroked, clips, and is found by its name") {
  CHECK(
      area_of(
          "<clipPath id='c'><text font-family='DejaVu Sans' x='10' y='40' font-size='20'>I</text></clipPath>"
          "<rect width='90' height='70' clip-path='url(#c)'/>") ==
      Approx(area_of("<text font-family='DejaVu Sans' x='10' y='40' font-size='20'>I</text>")));
  const auto shapes =
      read(drawing("<text id='t' font-family='DejaVu Sans' x='10' y='40' font-size='20' stroke='#f00' "
                   "stroke-width='1'>I</text>"))
          .shapes;
  REQUIRE(shapes.size() == 2);
  CHECK(has_name(shapes[1], "t"));
  CHECK(bounds(shapes[1].region).size().x() == Approx(bounds(shapes[0].region).size().x() + 1).margin(0.01));
}

TEST_CASE("a font that is not installed is named, and so is a way of writing that is not drawn") {
  CHECK_THAT(notes_of("<text x='10' y='40' font-family='No Such Font 77'>I</text>"),
             Contains("No Such Font 77") && Contains("not installed"));
  CHECK_THAT(notes_of("<text font-family='DejaVu Sans' x='10' y='40' text-decoration='underline'>I</text>"),
             Contains("decoration"));
  CHECK_THAT(notes_of("<text font-family='DejaVu Sans'>a<textPath href='#p'>b</textPath></text>"),
             Contains("along a path"));
}
