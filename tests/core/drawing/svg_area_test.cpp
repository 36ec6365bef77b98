// Which area of which colour is seen: strokes, markers, clip paths, masks, opacity, gradients, contours.
#include <catch2/catch.hpp>

#include "tests/core/drawing/drawing_support.hpp"

using namespace unicursal::core;
using Catch::Matchers::Contains;

namespace {

constexpr double pi = std::numbers::pi;

std::map<std::string, double> areas(const std::string& elements) {
  return seen_areas(read(drawing(elements)).shapes);
}

}  // namespace

TEST_CASE("a stroke is area of its own colour, over its fill or under it") {
  const auto over =
      areas("<rect x='5' y='5' width='30' height='20' fill='#00f' stroke='#f00' stroke-width='2'/>");
  CHECK(over.at("#0000ff") == Approx(28 * 18));
  CHECK(over.at("#ff0000") == Approx(32 * 22 - 28 * 18));
  const auto under = areas(
      "<rect x='5' y='5' width='30' height='20' fill='#00f' stroke='#f00' stroke-width='2' "
      "paint-order='stroke'/>");
  CHECK(under.at("#0000ff") == Approx(600));
  CHECK(area_of("<line x1='10' y1='10' x2='30' y2='10' stroke='#000' stroke-width='2'/>") == Approx(40));
  CHECK(area_of("<g stroke='#000' stroke-width='2' fill='none'><polyline points='10 10 30 10 30 30'/></g>") ==
        Approx(80));
  CHECK(
      area_of("<line x1='10' y1='10' x2='30' y2='10' stroke='#000' stroke-width='2' stroke-opacity='0'/>") ==
      0);
}

TEST_CASE("a stroke is stretched with its shape, or keeps its width") {
  const std::string line = "<line x1='10' y1='10' x2='30' y2='10' stroke='#000' stroke-width='2'";
  CHECK(area_of(line + " transform='scale(1 3)'/>") == Approx(20 * 6));
  CHECK(area_of(line + " transform='scale(3 1)'/>") == Approx(60 * 2));
  CHECK(area_of(line + " transform='scale(-1 1) translate(-50 0)'/>") == Approx(40));
  CHECK(area_of(line + " transform='scale(2)' vector-effect='non-scaling-stroke'/>") == Approx(40 * 2));
  CHECK(area_of(line + " stroke-dasharray='25 25' pathLength='100'/>") == Approx(20));
}

TEST_CASE("hairlines are left out with a note, or are contours if the job says so") {
  const std::string cut = drawing(
      "<path d='M5 5H35V25H5Z' fill='none' stroke='#f00' stroke-width='0.1'/>"
      "<path d='M15 10H25V20' fill='none' stroke='#f00' stroke-width='0.1'/>"
      "<path d='M15 10V20H25' fill='none' stroke='#f00' stroke-width='0.1'/>"
      "<path d='M60 10H70' fill='none' stroke='#f00' stroke-width='0.1'/>");
  const Reading plain = read(cut);
  CHECK(plain.shapes.empty());
  REQUIRE(plain.warnings.size() == 1);
  CHECK_THAT(plain.warnings[0], Contains("outline = \"strokes\"") && Contains("3 more"));
  DrawingOptions options;
  options.strokes_are_contours = true;
  const Reading contours = read(cut, options);
  REQUIRE(contours.shapes.size() == 1);
  CHECK(contours.shapes[0].fill == "#ff0000");
  CHECK(area(contours.shapes[0].region) == Approx(500));
  REQUIRE(contours.warnings.size() == 1);
  CHECK_THAT(contours.warnings[0], Contains("1 of the drawing's lines"));
}

TEST_CASE("clip paths cut") {
  const std::string clip = "<clipPath id='c'><circle cx='20' cy='15' r='10'/></clipPath>";
  const std::string rect = "<rect x='5' y='5' width='30' height='20' ";
  CHECK(area_of(clip + rect + "clip-path='url(#c)'/>") == Approx(100 * pi).epsilon(0.002));
  CHECK(area_of(clip + "<g clip-path='url(#c)' transform='translate(5 0)'>" + rect + "/></g>") ==
        Approx(100 * pi).epsilon(0.002));
  CHECK(
      area_of("<clipPath id='c' clipPathUnits='objectBoundingBox'><rect width='.5' height='.5'/></clipPath>" +
              rect + "clip-path='url(#c)'/>") == Approx(150));
  CHECK(area_of(
            "<clipPath id='d'><rect width='20' height='80'/></clipPath><clipPath id='c' clip-path='url(#d)'>"
            "<rect width='100' height='15'/></clipPath>" +
            rect + "clip-path='url(#c)'/>") == Approx(150));
  CHECK(area_of("<clipPath id='c'><path clip-rule='evenodd' d='M0 0H90V70H0ZM10 10H30V20H10Z'/></clipPath>" +
                rect + "clip-path='url(#c)'/>") == Approx(400));
  CHECK(area_of("<clipPath id='c'/>" + rect + "clip-path='url(#c)'/>") == 0);
  CHECK(area_of("<rect id='r' width='9' height='9'/><clipPath id='c'><use href='#r'/></clipPath>" + rect +
                "clip-path='url(#c)'/>") == Approx(81));
  // Groups do not belong into a clip path.
  CHECK(area_of("<clipPath id='c'><g><rect width='90' height='70'/></g></clipPath>" + rect +
                "clip-path='url(#c)'/>") == 0);
  CHECK_THAT(notes_of(rect + "clip-path='url(#none)'/>"), Contains("does not hold"));
  CHECK_THAT(notes_of("<clipPath id='c'><rect width='9' height='9' clip-path='url(#c)'/></clipPath>" + rect +
                      "clip-path='url(#c)'/>"),
             Contains("leads back"));
}

TEST_CASE("masks cut where they let less than half through") {
  const std::string rect = "<rect x='5' y='5' width='30' height='20' mask='url(#m)'/>";
  CHECK(area_of("<mask id='m'><circle cx='20' cy='15' r='10' fill='#fff'/></mask>" + rect) ==
        Approx(100 * pi).epsilon(0.002));
  CHECK(area_of("<mask id='m'><rect width='99' height='79' fill='#fff'/><rect x='10' y='10' width='10' "
                "height='10'/>"
                "</mask>" +
                rect) == Approx(500));
  CHECK(area_of("<mask id='m'><rect width='99' height='79' fill='#333'/></mask>" + rect) == 0);
  CHECK(area_of("<mask id='m' mask-type='alpha'><rect width='20' height='79' fill='#000'/></mask>" + rect) ==
        Approx(300));
  CHECK(area_of("<mask id='m' maskContentUnits='objectBoundingBox'><rect width='.5' height='1' "
                "fill='#fff'/></mask>" +
                rect) == Approx(300));
  CHECK(area_of("<mask id='m' x='0' y='0' width='0.5' height='1'><rect width='99' height='79' "
                "fill='#fff'/></mask>" +
                rect) == Approx(300));
  CHECK_THAT(notes_of("<mask id='m'><rect width='99' height='79' fill='#ccc'/></mask>" + rect),
             Contains("masked gradually"));
}

TEST_CASE("what is less than half opaque does not cover") {
  const std::string red = "<rect x='5' y='5' width='30' height='20' fill='#f00'/>";
  const std::string white = "<rect x='5' y='5' width='30' height='20' fill='#fff' ";
  const auto only_red = std::map<std::string, double>{{"#ff0000", 600}};
  CHECK(areas(red + white + "opacity='0.1'/>") == only_red);
  CHECK(areas(red + white + "fill-opacity='40%'/>") == only_red);
  CHECK(areas(red + "<g opacity='0.6'>" + white + "opacity='0.6'/></g>") == only_red);
  CHECK(areas(red + "<rect width='90' height='70' fill='rgba(0,0,0,.2)'/>") == only_red);
  CHECK_THAT(notes_of(red + white + "opacity='0.1'/>"), Contains("less than half opaque"));
  CHECK(areas(red + white + "opacity='0.7'/>").at("#ffffff") == Approx(600));
  CHECK_THAT(notes_of(red + white + "opacity='0.7'/>"), Contains("partly transparent"));
}

TEST_CASE("a gradient is one zone, and the note says how it runs") {
  const std::string stops = "<stop offset='0' stop-color='#f00'/><stop offset='1' style='stop-color:#00f'/>";
  const std::string text = "<linearGradient id='g' x1='0' x2='0' y1='0' y2='1'>" + stops +
                           "</linearGradient><rect width='20' height='30' fill='url(#g)'/>";
  CHECK(areas(text).at("url(#g)") == Approx(600));
  CHECK_THAT(notes_of(text),
             Contains("from #ff0000 to #0000ff") && Contains("[0, -1, 0]") && Contains("url(#g)"));
  CHECK(areas("<linearGradient id='h'><stop stop-color='#0f0'/></linearGradient><linearGradient id='g' "
              "href='#h'/>"
              "<rect width='20' height='30' fill='url(#g)'/>")
            .at("#00ff00") == Approx(600));
  // A gloss, all but transparent, does not hide what is below.
  CHECK(
      areas("<linearGradient id='g'><stop stop-color='#fff' stop-opacity='0'/><stop offset='1' "
            "stop-color='#fff' "
            "stop-opacity='.2'/></linearGradient><rect width='20' height='30' fill='#f00'/><rect width='20' "
            "height='30' fill='url(#g)'/>") == std::map<std::string, double>{{"#ff0000", 600}});
  CHECK(areas("<rect width='20' height='30' fill='url(#none)'/>").empty());
  CHECK_THAT(notes_of("<rect width='20' height='30' fill='url(#none)'/>"), Contains("gradient or pattern"));
  CHECK(areas("<rect width='20' height='30' fill='url(#none) gold'/>").at("#ffd700") == Approx(600));
  CHECK(areas("<rect width='20' height='30' color='gold' fill='url(#none) currentColor'/>").at("#ffd700") ==
        Approx(600));
}

TEST_CASE("filters, blend modes and patterns are named") {
  CHECK_THAT(notes_of("<rect width='9' height='9' filter='url(#f)'/>"), Contains("filter"));
  CHECK_THAT(notes_of("<rect width='9' height='9' style='mix-blend-mode:multiply'/>"), Contains("blend"));
  CHECK_THAT(notes_of("<pattern id='p'/><rect width='9' height='9' fill='url(#p)'/>"), Contains("pattern"));
}

TEST_CASE("markers are drawn at the corners, turned and as large as the stroke is wide") {
  const std::string marker =
      "<marker id='m' markerWidth='2' markerHeight='2' refX='1' refY='1'><rect width='2' "
      "height='2' fill='#f00'/></marker>";
  const std::string line = "<path fill='none' stroke-width='3' d='M20 20H40V40' ";
  CHECK(areas(marker + line + "marker-start='url(#m)'/>").at("#ff0000") == Approx(36));
  CHECK(areas(marker + line + "marker-mid='url(#m)'/>").at("#ff0000") == Approx(36));
  CHECK(areas(marker + line + "style='marker:url(#m)'/>").at("#ff0000") == Approx(3 * 36));
  const std::string arrow =
      "<marker id='m' orient='auto' markerUnits='userSpaceOnUse' markerWidth='20' "
      "markerHeight='20' refY='5'><rect width='10' height='1' y='4.5'/></marker>";
  const auto shapes = read(drawing(arrow + line + "marker-end='url(#m)'/>")).shapes;
  REQUIRE(shapes.size() == 1);
  CHECK(bounds(shapes[0].region).size().isApprox(Vec2(1, 10), 1e-5));
  // What sticks out of the marker's viewport is cut off.
  CHECK(areas("<marker id='m' markerWidth='2' markerHeight='2'><rect width='9' height='9' x='-5' y='-5' "
              "fill='#f00'/></marker>" +
              line + "marker-start='url(#m)'/>")
            .at("#ff0000") == Approx(36));
}
