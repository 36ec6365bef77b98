#include "core/drawing/svg_reader.hpp"

#include <catch2/catch.hpp>

#include "tests/core/drawing/drawing_support.hpp"

using namespace unicursal::core;
using Catch::Matchers::Contains;

TEST_CASE("basic shapes have their areas and lie upside up") {
  const auto shapes = read(drawing("<rect x='10' y='20' width='30' height='40'/>"
                                   "<rect width='30' height='40' rx='5'/>"
                                   "<circle cx='50' cy='40' r='20'/>"
                                   "<ellipse cx='50' cy='40' rx='30' ry='10'/>"
                                   "<polygon points='0,0 10,0 10,10'/>"
                                   "<polyline points='0 0 10 0 10 10 0 10'/>"
                                   "<rect width='10mm' height='10%'/>"
                                   "<rect style='width:2em;height:1ex;font-size:10px'/>"))
                          .shapes;
  REQUIRE(shapes.size() == 8);
  const double pi = std::numbers::pi;
  CHECK(area(shapes[0].region) == Approx(1200));
  CHECK(bounds(shapes[0].region).min == Vec2(10, 20));
  CHECK(bounds(shapes[0].region).max == Vec2(40, 60));
  CHECK(area(shapes[1].region) == Approx(1200 - (4 - pi) * 25).margin(0.5));
  CHECK(area(shapes[2].region) == Approx(400 * pi).margin(1.3));
  CHECK(area(shapes[3].region) == Approx(300 * pi).margin(1.4));
  CHECK(area(shapes[4].region) == Approx(50));
  CHECK(bounds(shapes[4].region).max.y() == Approx(80));
  CHECK(area(shapes[5].region) == Approx(100));
  // 10 mm are 37.8 user units here, since a pixel of this page is 1 mm.
  CHECK(area(shapes[6].region) == Approx(10 * 96 / 25.4 * 8));
  CHECK(area(shapes[7].region) == Approx(20 * 5));
}

TEST_CASE("fill rules decide about holes") {
  const std::string d = "M0 0H40V40H0ZM10 10H30V30H10Z";
  CHECK(area(read(drawing("<path d='" + d + "'/>")).shapes.at(0).region) == Approx(1600));
  CHECK(area(read(drawing("<path fill-rule='evenodd' d='" + d + "'/>")).shapes.at(0).region) == Approx(1200));
  CHECK(area(read(drawing("<g style='fill-rule:evenodd'><path d='" + d + "'/></g>")).shapes.at(0).region) ==
        Approx(1200));
}

TEST_CASE("fills come from style before attribute before group") {
  const auto fill = [](const std::string& element) { return read(drawing(element)).shapes.at(0).fill; };
  const std::string size = " width='9' height='9'/>";
  CHECK(fill("<rect" + size) == "#000000");
  CHECK(fill("<rect fill='red'" + size) == "#ff0000");
  CHECK(fill("<rect fill='red' style='fill: #00F'" + size) == "#0000ff");
  CHECK(fill("<g fill='lime'><g><rect" + size + "</g></g>") == "#00ff00");
  CHECK(fill("<g fill='lime'><rect fill='inherit'" + size + "</g>") == "#00ff00");
  CHECK(fill("<g style='fill:lime'><rect fill='red'" + size + "</g>") == "#ff0000");
  CHECK(fill("<g color='teal'><rect fill='currentColor'" + size + "</g>") == "#008080");
  CHECK(fill("<rect fill='url(#none) gold'" + size) == "#ffd700");
  CHECK(fill("<rect style='fill:blue !important;stroke:url(a;b)'" + size) == "#0000ff");
}

TEST_CASE("malformed style entries are skipped with a warning, the others count") {
  const Reading reading =
      read(drawing("\n<rect id='r' width='9' height='9'"
                   " style='fill:#0000FF; stroke=#000000; stroke-width:0.1px; fill:bleu; :x'/>"));
  CHECK(reading.shapes.at(0).fill == "#0000ff");
  REQUIRE(reading.warnings.size() == 3);
  CHECK_THAT(reading.warnings[0], Contains("line 2") && Contains("\"r\"") && Contains("stroke=#000000"));
  CHECK_THAT(reading.warnings[2], Contains("bleu"));
}

TEST_CASE("elements that are not filled or not shown are not shapes") {
  const auto element = GENERATE(
      "<rect fill='none' width='9' height='9'/>", "<rect style='display:none' width='9' height='9'/>",
      "<g display='none'><g display='inline'><rect width='9' height='9'/></g></g>",
      "<g visibility='hidden'><rect width='9' height='9'/></g>",
      "<rect fill-opacity='0' width='9' height='9'/>", "<defs><rect width='9' height='9'/></defs>",
      "<clipPath><rect width='9' height='9'/></clipPath>", "<symbol><rect width='9' height='9'/></symbol>",
      "<line x2='9' y2='9'/>", "<rect width='9'/>", "<circle r='0'/>", "<path/>", "<polygon points=''/>");
  CAPTURE(element);
  const Reading reading = read(drawing(element));
  CHECK(reading.shapes.empty());
  CHECK(reading.warnings.empty());
}

TEST_CASE("a visible child of a hidden group is shown") {
  CHECK(read(drawing("<g visibility='hidden'><rect visibility='visible' width='9' height='9'/></g>"))
            .shapes.size() == 1);
}

TEST_CASE("pictures are skipped with a note that counts them") {
  const Reading reading = read(drawing("<image id='x'/><image/><rect width='9' height='9'/>"));
  CHECK(reading.shapes.size() == 1);
  REQUIRE(reading.warnings.size() == 1);
  CHECK_THAT(reading.warnings.front(),
             Contains("\"x\"") && Contains("convert it to a path") && Contains("1 more"));
}

TEST_CASE("transforms nest") {
  const auto shapes =
      read(drawing("<g transform='translate(10 10)'><g transform='scale(2)'>"
                   "<rect transform='rotate(90)' x='0' y='-5' width='3' height='5'/></g></g>"))
          .shapes;
  // The rectangle turns to x 0…5, y 0…3, then doubles, then moves.
  CHECK(bounds(shapes.at(0).region).min.isApprox(Vec2(10, 80 - 16), 1e-6));
  CHECK(bounds(shapes.at(0).region).max.isApprox(Vec2(20, 80 - 10), 1e-6));
}

TEST_CASE("a shape is known by its own names and its groups'") {
  const auto shapes =
      read(drawing(
               "<g id='outer' inkscape:label='Layer 1'><rect id='own' name='n' width='9' height='9'/></g>"))
          .shapes;
  CHECK(all_names(shapes.at(0)) == std::vector<std::string>{"own", "n", "outer", "Layer 1"});
  CHECK(has_name(shapes.at(0), "outer"));
  CHECK_FALSE(has_name(shapes.at(0), "Layer"));
}

TEST_CASE("what is not a drawing is refused") {
  CHECK_THAT(refusal_of("<html/>"), Contains("not an SVG"));
  CHECK_THAT(refusal_of("<svg><rect"), Contains("XML"));
  CHECK_THAT(refusal_of(""), Contains("XML"));
  CHECK_THAT(refusal_of("\x01\x02\x03"), Contains("XML"));
  CHECK_THAT(refusal_of("<svg width='1mm' height='1mm' viewBox='0 0 0 0'/>"), Contains("viewBox"));
}

TEST_CASE("damaged elements are drawn as far as they are sound, with a note") {
  CHECK(area_of("<path d='M0 0H10V10H0Z L'/>") == Approx(100));
  CHECK_THAT(notes_of("\n\n<path id='p' d='M0 0H10V10Z L1'/>"),
             Contains("line 3") && Contains("\"p\"") && Contains("up to there"));
  CHECK(area_of("<polygon points='0,0 10,0 10,10 0,10 5'/>") == Approx(100));
  CHECK_THAT(notes_of("<polygon points='1 2 3'/>"), Contains("number is missing"));
  CHECK(area_of("<g transform='spin(1)'><rect width='9' height='9'/></g>") == Approx(81));
  CHECK_THAT(notes_of("<g transform='spin(1)'/>"), Contains("spin"));
  CHECK(area_of("<circle r='-1'/><rect width='9' height='9'/>") == Approx(81));
  CHECK_THAT(notes_of("<circle r='-1'/>"), Contains("negative"));
  CHECK(area_of("<rect width='9' height='9' rx='-1'/>") == Approx(81));
  CHECK_THAT(notes_of("<path d='M0 0H9V9' stroke='red' stroke-miterlimit='4mm'/>"),
             Contains("stroke-miterlimit"));
  CHECK_THAT(notes_of("<rect width='3furlong' height='2'/>"), Contains("furlong"));
  CHECK_THAT(notes_of("<path d='M0 0H1e9V1e9Z'/>"), Contains("100 m") && Contains("left out"));
}

TEST_CASE("groups nested without end are refused, not followed") {
  std::string text;
  for (int i = 0; i < 100000; ++i) text += "<g>";
  for (int i = 0; i < 100000; ++i) text += "</g>";
  CHECK_THAT(refusal_of(drawing(text)), Contains("nested"));
}

TEST_CASE("a drawing full of mistakes gives a bounded number of warnings") {
  std::string text;
  for (int i = 0; i < 1000; ++i) text += "<rect id='t" + std::to_string(i) + "' width='x'/>";
  CHECK(read(drawing(text)).warnings.size() <= 21);
}

TEST_CASE("text from a file is quoted without its control characters and cut") {
  CHECK(in_quotes("a\x1b[31m\nb") == "\"a?[31m?b\"");
  CHECK(in_quotes(std::string(100, 'x')).size() < 50);
  // A character of several bytes is not cut in two.
  CHECK(in_quotes(std::string(39, 'x') + "äöü") == "\"" + std::string(39, 'x') + "...\"");
}
