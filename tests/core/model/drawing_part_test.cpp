#include <catch2/catch.hpp>

#include "core/error.hpp"
#include "core/model/read_part.hpp"
#include "model_support.hpp"
#include "tests/paths.hpp"

using namespace unicursal::core;
using Catch::Matchers::Contains;

namespace {

std::string refusal(const std::string& elements, const std::vector<std::string>& selects,
                    double layer_height = 0.2, double height = 1.0) {
  const TempFolder folder;
  try {
    part({folder.write("shapes.svg", drawing(elements))}, selects, layer_height, height);
  } catch (const ModelError& error) {
    return error.what();
  }
  return "";
}

const std::string two_squares =
    "<rect id='left' fill='blue' width='20' height='20'/><rect id='right' fill='#f00' x='20' width='20' "
    "height='20'/>";

}  // namespace

TEST_CASE("a drawing with two zones becomes layers of one island") {
  const auto p = part({test_data("two_zones.svg")}, {"#0000FF", "crimson"});
  CHECK(p->layer_count() == 5);
  CHECK(p->height() == Approx(1));
  CHECK(p->extent().min.isApprox(Vec2(5, 5), 1e-6));
  CHECK(p->extent().max.isApprox(Vec2(55, 35), 1e-6));
  const Layer last = p->layer(4);
  CHECK(last.index == 4);
  CHECK(last.z == Approx(0.9));
  CHECK(last.top == Approx(1));
  CHECK(last.height == Approx(0.2));
  REQUIRE(last.islands.size() == 1);
  // 50 × 30 mm with a round hole of 5 mm radius; a disc of 10 mm radius in the second colour.
  const double pi = std::numbers::pi;
  CHECK(area(last.islands[0].outline) == Approx(1500 - 25 * pi).margin(0.5));
  CHECK(zone_area(last, 1) == Approx(100 * pi).margin(0.7));
  CHECK(last.islands[0].outline.holes.size() == 1);
  REQUIRE(p->warnings().size() == 1);
  CHECK_THAT(p->warnings()[0], Contains("stroke=#000000"));
}

TEST_CASE("a drawing's first layer may have its own height") {
  PartSource source;
  source.files = {test_data("two_zones.svg")};
  source.height = 1.1;
  source.layer_height = 0.2;
  source.first_layer_height = 0.3;
  source.zones = {{"#0000FF", {}, 0}, {"crimson", {}, 1}};
  const auto exact = read_part(source);
  CHECK(exact->layer_count() == 5);
  CHECK(exact->height() == Approx(1.1));
  CHECK(exact->layer(4).top == Approx(1.1));
  CHECK(exact->warnings().size() == 1);  // of the stroke, none of the height
  source.height = 1.03;
  const auto off = read_part(source);
  CHECK(off->layer_count() == 5);
  CHECK(off->warnings().size() == 2);
}

TEST_CASE("zones are found by colour in any spelling, by name, or by the file's name") {
  const TempFolder folder;
  const auto file = folder.write("shapes.svg", drawing("<g inkscape:label='all'>" + two_squares + "</g>"));
  const std::vector<std::string> ways =
      GENERATE(std::vector<std::string>{"#0000ff", "#ff0000"}, std::vector<std::string>{"#00F", "RED"},
               std::vector<std::string>{"left", "right"}, std::vector<std::string>{"all"},
               std::vector<std::string>{"shapes.svg"}, std::vector<std::string>{"shapes"});
  const Layer layer = part({file}, ways)->layer(0);
  REQUIRE(layer.islands.size() == 1);
  CHECK(layer.islands[0].zones.size() == ways.size());
  CHECK(outline_area(layer) == Approx(800));
}

TEST_CASE("a select that matches nothing is refused with the choices") {
  CHECK_THAT(refusal(two_squares, {"#0000ff", "#ff0000", "green"}),
             Contains("green") && Contains("#0000ff") && Contains("#ff0000") && Contains("left"));
  CHECK_THAT(refusal(two_squares, {""}), Contains("matches nothing"));
}

TEST_CASE("two zones must not select one shape") {
  CHECK_THAT(refusal(two_squares, {"#0000ff", "#ff0000", "left"}),
             Contains("left") && Contains("already selected"));
  CHECK_THAT(refusal(two_squares, {"blue", "#00f", "red"}), Contains("already selected"));
}

TEST_CASE("an area without a zone is refused with colour, place and size") {
  CHECK_THAT(refusal(two_squares, {"blue"}),
             Contains("#ff0000") && Contains("400 mm²") && Contains("near ("));
}

TEST_CASE("a zone that other shapes cover is reported, and does no harm") {
  const TempFolder folder;
  const auto file = folder.write("c.svg", drawing("<rect fill='red' width='9' height='9'/>"
                                                  "<rect fill='blue' width='9' height='9'/>"));
  const auto p = part({file}, {"red", "blue"});
  CHECK(p->layer(0).islands.at(0).zones.size() == 1);
  REQUIRE(p->warnings().size() == 1);
  CHECK_THAT(p->warnings()[0], Contains("red") && Contains("cover"));
}

TEST_CASE("heights that make no layers are refused") {
  CHECK_THAT(refusal(two_squares, {"blue", "red"}, 0.2, 0), Contains("height") && Contains("0 mm"));
  CHECK_THAT(refusal(two_squares, {"blue", "red"}, 0.2, -1), Contains("height"));
  CHECK_THAT(refusal(two_squares, {"blue", "red"}, 0, 1), Contains("layer_height"));
  CHECK_THAT(refusal(two_squares, {"blue", "red"}, NAN, 1), Contains("layer_height"));
  CHECK_THAT(refusal(two_squares, {"blue", "red"}, 0.2, INFINITY), Contains("height"));
  CHECK_THAT(refusal(two_squares, {"blue", "red"}, 1e-9, 1), Contains("million"));
}

TEST_CASE("layers are counted to the nearest, with a warning when they do not fit") {
  const auto count = [](double height) {
    const auto p = part({test_data("two_zones.svg")}, {"blue", "crimson"}, 0.2, height);
    return std::pair(p->layer_count(), p->warnings().size() - 1);
  };
  CHECK(count(1.0) == std::pair<std::size_t, std::size_t>(5, 0));
  CHECK(count(0.6) == std::pair<std::size_t, std::size_t>(3, 0));  // 0.6 / 0.2 is not 3 in binary
  CHECK(count(1.05) == std::pair<std::size_t, std::size_t>(5, 1));
  CHECK(count(0.05) == std::pair<std::size_t, std::size_t>(1, 1));
}

TEST_CASE("files that are missing, empty or of no known kind") {
  const TempFolder folder;
  CHECK_THROWS_AS(part({"no/such/file.svg"}, {"a"}), FileError);
  CHECK_THROWS_AS(part({unicursal::test::data_folder()}, {"a"}), ModelError);
  std::filesystem::create_directory(folder.write("x", "").parent_path() / "folder.svg");
  CHECK_THROWS_AS(part({folder.write("y", "").parent_path() / "folder.svg"}, {"a"}), FileError);
  CHECK_THAT(refusal("", {"a"}), Contains("no area"));
  CHECK_THROWS_AS(part({folder.write("p.gcode", "G28")}, {"a"}), ModelError);
  CHECK_THROWS_AS(part({}, {"a"}), ModelError);
  CHECK_THROWS_AS(part({test_data("two_zones.svg")}, {}), ModelError);
  CHECK_THROWS_AS(part({test_data("two_zones.svg"), test_data("cube20.stl")}, {"blue"}), ModelError);
}
