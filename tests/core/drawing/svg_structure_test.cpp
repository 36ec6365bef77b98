// Styles, clones, drawings inside drawings, conditions, entities: which elements are drawn, how, and where.
#include <catch2/catch.hpp>

#include "tests/core/drawing/drawing_support.hpp"

using namespace unicursal::core;
using Catch::Matchers::Contains;

namespace {

using Areas = std::map<std::string, double>;

Areas areas(const std::string& elements) {
  return seen_areas(read(drawing(elements)).shapes);
}

/// The only shape's box, with y down as in the drawing.
Box box(const std::string& elements) {
  const auto shapes = read(drawing(elements)).shapes;
  REQUIRE(shapes.size() == 1);
  const Box found = bounds(shapes.front().region);
  return {{found.min.x(), 80 - found.max.y()}, {found.max.x(), 80 - found.min.y()}};
}

void check_box(const std::string& elements, double x0, double y0, double x1, double y1) {
  CAPTURE(elements);
  const Box found = box(elements);
  CHECK(found.min.isApprox(Vec2(x0, y0), 1e-5));
  CHECK(found.max.isApprox(Vec2(x1, y1), 1e-5));
}

const std::string rect = "<rect x='10' y='10' width='10' height='10'/>";

}  // namespace

TEST_CASE("style sheets colour by class, and hide") {
  const std::string sheet = "<style>.a{fill:#f00}.b{fill:#00f}.hidden{display:none}</style>";
  CHECK(areas(sheet + "<rect class='a' width='10' height='5'/><rect class='b' x='20' width='10' height='4'/>"
                      "<rect class='hidden a' width='90' height='70'/>") ==
        Areas{{"#ff0000", 50}, {"#0000ff", 40}});
}

TEST_CASE("the cascade: attribute, rule, style attribute, important rule, important style") {
  const auto fill = [](const std::string& text) { return areas(text).begin()->first; };
  const std::string size = " width='9' height='9'";
  CHECK(fill("<style>rect{fill:#00f}</style><rect fill='#f00'" + size + "/>") == "#0000ff");
  CHECK(fill("<style>rect{fill:#00f}</style><rect style='fill:#0f0'" + size + "/>") == "#00ff00");
  CHECK(fill("<style>rect{fill:#00f!important}</style><rect style='fill:#0f0'" + size + "/>") == "#0000ff");
  CHECK(fill("<style>rect{fill:#00f!important}</style><rect style='fill:#0f0!important'" + size + "/>") ==
        "#00ff00");
  CHECK(fill("<style>g rect{fill:#00f} g>rect{fill:#0ff}</style><g><rect" + size + "/></g>") == "#00ffff");
  CHECK(fill("<style>g{fill:#00f}</style><g><rect" + size + "/></g>") == "#0000ff");
  CHECK(fill("<g fill='#0f0'><rect style='fill:inherit' fill='#f00'" + size + "/></g>") == "#00ff00");
  CHECK(fill("<g fill='#0f0'><rect style='fill:initial'" + size + "/></g>") == "#000000");
  CHECK(fill("<g color='#0f0' fill='currentColor'><rect color='#00f'" + size + "/></g>") == "#0000ff");
}

TEST_CASE("a style sheet comes from a CDATA section, and after what it colours") {
  CHECK(areas(rect + "<style><![CDATA[ rect > x, rect { fill : #f00 } ]]></style>") ==
        Areas{{"#ff0000", 100}});
  CHECK_THAT(notes_of("<style>@import 'a.css';</style>"), Contains("is not read"));
  CHECK(areas("<style type='text/less'>rect{fill:red}</style>" + rect) == Areas{{"#000000", 100}});
}

TEST_CASE("clones are drawn at their place, in their colour, and known by both names") {
  check_box("<defs><rect id='r' width='10' height='10'/></defs><use href='#r' x='5' y='6'/>", 5, 6, 15, 16);
  check_box(
      "<defs><rect id='r' width='10' height='10'/></defs><use xlink:href='#r' transform='scale(2)' x='5'/>",
      10, 0, 30, 20);
  const auto shapes = read(drawing("<defs><g id='group'><rect id='r' width='10' height='10'/></g></defs>"
                                   "<use id='clone' href='#group' fill='#f00'/>"))
                          .shapes;
  REQUIRE(shapes.size() == 1);
  CHECK(shapes[0].fill == "#ff0000");
  CHECK(all_names(shapes[0]) == std::vector<std::string>{"r", "group", "clone"});
}

TEST_CASE("symbols and drawings inside the drawing have viewports of their own") {
  const std::string symbol = "<symbol id='s' viewBox='0 0 10 10'><rect width='10' height='10'/></symbol>";
  check_box(symbol + "<use href='#s' x='20' y='30' width='40' height='20'/>", 30, 30, 50, 50);
  check_box("<symbol id='s'><rect width='90' height='9'/></symbol><use href='#s' width='30' height='40'/>", 0,
            0, 30, 9);
  check_box(
      "<svg x='5' y='5' width='30' height='20' viewBox='0 0 15 10'><rect width='15' height='10'/></svg>", 5,
      5, 35, 25);
  check_box(
      "<svg x='5' y='5' width='30' height='20' viewBox='0 0 10 10' preserveAspectRatio='none'>"
      "<rect width='5' height='5'/></svg>",
      5, 5, 20, 15);
  // What sticks out is cut off, unless it may be seen.
  check_box("<svg width='30' height='20'><rect x='-5' width='90' height='10'/></svg>", 0, 0, 30, 10);
  check_box("<svg width='30' height='20' overflow='visible'><rect x='0' width='90' height='10'/></svg>", 0, 0,
            90, 10);
  check_box("<svg width='50%' height='50%'><rect width='100%' height='50%'/></svg>", 0, 0, 50, 20);
  CHECK(read(drawing("<symbol><rect width='9' height='9'/></symbol>")).shapes.empty());
}

TEST_CASE("clones that lead back to themselves are left out with a note") {
  const auto text =
      GENERATE("<g id='a'><use href='#a'/></g>",
               "<g id='a'><use href='#b'/></g><g id='b'><use href='#a'/></g>", "<use id='a' href='#a'/>");
  CAPTURE(text);
  CHECK_THAT(notes_of(text), Contains("leads back to itself"));
  CHECK_THAT(notes_of("<use href='#nowhere'/>"), Contains("does not hold"));
}

TEST_CASE("clones that multiply without end are refused", "[optimised]") {
  std::string text = "<defs><rect id='c0' width='1' height='1'/>";
  for (int i = 1; i < 40; ++i) {
    const std::string before = "<use href='#c" + std::to_string(i - 1) + "'/>";
    text += "<g id='c" + std::to_string(i) + "'>" + before + before + before + before + "</g>";
  }
  CHECK_THAT(refusal_of(drawing(text + "</defs><use href='#c39'/>")),
             Contains("million") && Contains("simplify"));
}

TEST_CASE("a switch shows its first child that fits, in English") {
  CHECK(areas("<switch><g systemLanguage='xx'><rect width='90' height='9'/></g><g fill='#f00'>" + rect +
              "</g>" + rect + "</switch>") == Areas{{"#ff0000", 100}});
  CHECK(areas("<switch><rect systemLanguage='de, en-GB' width='9' height='1'/>" + rect + "</switch>") ==
        Areas{{"#000000", 9}});
  CHECK(areas("<switch><foreignObject requiredExtensions='http://x'/>" + rect + "</switch>") ==
        Areas{{"#000000", 100}});
}

TEST_CASE("transforms of style sheets replace the attribute and turn about their origin") {
  check_box("<rect x='10' y='10' width='10' height='10' style='transform:scale(.5)'/>", 5, 5, 10, 10);
  check_box(
      "<rect x='10' y='10' width='10' height='10' transform='scale(3)' style='transform:translate(5px,0)'/>",
      15, 10, 25, 20);
  check_box("<rect x='10' y='10' width='10' height='10' transform='scale(2)' transform-origin='10 10'/>", 10,
            10, 30, 30);
  check_box(
      "<rect x='10' y='10' width='10' height='10' style='transform:scale(2);transform-box:fill-box;"
      "transform-origin:center'/>",
      5, 5, 25, 25);
}

TEST_CASE("entities are put in, and multiplied only so far") {
  const std::string body =
      "<svg width='10mm' height='10mm' viewBox='0 0 10 10'><rect style='&st0;' width='&w;' "
      "height='4'/>&more;</svg>";
  const auto shapes = read(
                          "<!DOCTYPE svg [<!ENTITY st0 \"fill:#F00;\"><!ENTITY w '5'>\n<!ENTITY more "
                          "\"<circle r='&w;'/>\">]>" +
                          body)
                          .shapes;
  REQUIRE(shapes.size() == 2);
  CHECK(shapes[0].fill == "#ff0000");
  CHECK(area(shapes[0].region) == Approx(20));
  std::string laughs = "<!DOCTYPE svg [<!ENTITY l0 'ha'>";
  for (int i = 1; i < 12; ++i) {
    const std::string before = "&l" + std::to_string(i - 1) + ";";
    laughs += "<!ENTITY l" + std::to_string(i) + " '";
    for (int k = 0; k < 10; ++k) laughs += before;
    laughs += "'>";
  }
  CHECK_THAT(refusal_of(laughs + "]><svg>&l11;</svg>"), Contains("multiply"));
  CHECK_THAT(refusal_of("<!DOCTYPE svg [<!ENTITY a '&b;'><!ENTITY b '&a;'>]><svg>&a;</svg>"),
             Contains("multiply"));
}

TEST_CASE("names of other vocabularies are not drawn, those with SVG's prefix are") {
  CHECK(read("<s:svg xmlns:s='http://www.w3.org/2000/svg' width='9mm' height='9mm' viewBox='0 0 9 9'>"
             "<s:rect width='3' height='3'/><rect width='9' height='9'/></s:svg>")
            .shapes.size() == 1);
  CHECK(area_of("<x:rect width='9' height='9'/><svg:rect width='3' height='3'/>") == Approx(9));
}

TEST_CASE("a vocabulary that an element declares holds for what is inside of it") {
  CHECK(
      area_of("<s:g xmlns:s='http://www.w3.org/2000/svg' xmlns='http://other'><s:rect width='3' height='3'/>"
              "<rect width='9' height='9'/></s:g>") == Approx(9));
  CHECK(area_of("<g xmlns:other='http://other'><rect width='3' height='3'/><other:rect width='9' "
                "height='9'/></g>") == Approx(9));
}

TEST_CASE("viewports, masks and pages as large as a country are read") {
  CHECK(area_of("<svg x='-1e9' y='-1e9' width='2e9' height='2e9'><rect x='1e9' y='1e9' width='9' "
                "height='9'/></svg>") == Approx(81));
  CHECK(area_of("<mask id='m' x='-9e9' y='-9e9' width='99e9' height='99e9'><rect width='9' height='80' "
                "fill='#fff'/>"
                "</mask><rect width='20' height='10' mask='url(#m)'/>") == Approx(90));
  CHECK(
      read("<svg width='1e15mm' height='1e15mm' viewBox='0 0 1 1'><rect width='1e-15' height='1e-15'/></svg>")
          .shapes.size() <= 1);
  CHECK_THAT(notes_of("<g transform='scale(1e300) scale(1e300)'><svg width='9' height='9'><rect/></svg></g>"),
             Contains("too far away"));
}

TEST_CASE("what lies outside of the page is cut off with a note") {
  CHECK(area_of("<rect x='90' width='20' height='10'/>") == Approx(100));
  CHECK_THAT(notes_of("<rect x='90' width='20' height='10'/>"), Contains("outside of the page"));
  CHECK(notes_of("<rect width='100' height='80'/>").empty());
  // A file that does not say how large its page is has no page.
  const auto loose = read("<svg><rect x='500' width='96' height='96'/></svg>").shapes;
  REQUIRE(loose.size() == 1);
  CHECK(area(loose[0].region) == Approx(25.4 * 25.4));
}
