#include "firmware_gcode/sliced/survey.hpp"

#include <catch2/catch.hpp>
#include <map>
#include <numbers>
#include <numeric>
#include <sstream>

#include "core/error.hpp"
#include "tests/firmware_gcode/support/sliced_block.hpp"

namespace unicursal::gcode {
namespace {

using test::BlockOptions;
using test::Style;

constexpr double area = std::numbers::pi / 4 * 1.75 * 1.75;

SlicedSurvey survey(const std::string& text, const Printer& printer = {}) {
  std::istringstream stream(text);
  return survey_sliced(stream, "part.gcode", printer, {});
}

}  // namespace

TEST_CASE("A survey reports what a file is", "[sliced]") {
  const auto style = GENERATE(from_range(std::begin(test::styles), std::end(test::styles)));
  CAPTURE(int(style));
  const test::Block block = test::sliced_block({style, 3, 7});
  const SlicedSurvey seen = survey(block.text);
  CHECK(seen.layers == 7);
  CHECK(seen.layer_height == Approx(0.2));
  CHECK(seen.first_layer_height == Approx(0.2));
  CHECK(seen.height == Approx(1.4));
  CHECK(seen.nozzle == 210);
  CHECK(seen.bed == 60);
  CHECK(seen.changes == 14);
  CHECK(seen.extent.max.x() == Approx(40 + 45 - 0.225).margin(1e-3));
  std::map<int, double> volumes;
  for (const test::BlockBead& bead : block.beads) volumes[bead.tool] += bead.filament * area;
  REQUIRE(seen.tools.size() == 3);
  double all = 0;
  for (const SlicedTool& tool : seen.tools) {
    CHECK(tool.volume == Approx(volumes.at(tool.number)).epsilon(1e-6));
    all += tool.volume;
  }
  CHECK(seen.volume == Approx(all));
  CHECK(seen.layer_seconds.size() == 7);
  CHECK(std::accumulate(seen.layer_seconds.begin(), seen.layer_seconds.end(), 0.0) <= seen.seconds + 1e-6);
  CHECK(seen.seconds > 60);
  CHECK(seen.tools[1].colour == (style == Style::prusaslicer || style == Style::orcaslicer ? "#00ff00" : ""));
  if (style == Style::cura) CHECK(seen.slicer == "Cura_SteamEngine 5.6.0");
  if (style == Style::prusaslicer) CHECK(seen.slicer == "PrusaSlicer 2.7.1");
  CHECK(seen.notes.empty() == (style != Style::bare));
}

TEST_CASE("A tower is kept apart from the part", "[sliced]") {
  BlockOptions options{Style::prusaslicer, 2, 5};
  options.tower = true;
  const test::Block block = test::sliced_block(options);
  CHECK(survey(block.text).tower_volume == Approx(block.tower_filament * area).epsilon(1e-6));
}

TEST_CASE("A part that begins before the nozzle is full of the first mixture is mentioned", "[sliced]") {
  Printer wide;
  wide.mixing_volume = 25;
  const SlicedSurvey seen = survey(test::sliced_block({Style::prusaslicer, 2, 5}).text, wide);
  REQUIRE(seen.notes.size() == 1);
  CHECK_THAT(seen.notes[0],
             Catch::Contains("only 7.") && Catch::Contains("takes 27.1 mm³") && Catch::Contains("skirt"));
}

TEST_CASE("A file that lays nothing is refused", "[sliced]") {
  CHECK_THROWS_WITH(survey(""), Catch::Contains("lays no plastic") && Catch::Contains("empty"));
  CHECK_THROWS_WITH(survey("hello\nworld\n"), Catch::Contains("lays no plastic"));
  CHECK_THROWS_WITH(survey("M109 S200\nG1 X1 Y1\nG1 E5\n"), Catch::Contains("lays no plastic"));
}

TEST_CASE("A hostile file costs no more memory than a sound one", "[sliced]") {
  std::string travels = "G28\nM109 S200\nM83\n";
  for (int i = 0; i < 200'001; ++i) travels += i % 2 == 0 ? "G1 X1\n" : "G1 X2\n";
  CHECK_THROWS_WITH(survey(travels), Catch::Contains("in a row that lays nothing"));
  std::string layers, words;
  for (int i = 0; i <= 1'000'000; ++i) layers += ";LAYER:1\n";
  CHECK_THROWS_WITH(survey(layers), Catch::Contains("layer 1000001"));
  const test::Block block = test::sliced_block({Style::prusaslicer, 2, 2});
  for (int i = 0; i < 100'000; ++i) words += "MACRO_" + std::to_string(i) + "\n";
  CHECK(survey(words + block.text).notes.size() <= 101);
}

TEST_CASE("Filament of another diameter is mentioned", "[sliced]") {
  Printer thick;
  thick.filament_diameter = 2.85;
  const SlicedSurvey seen = survey(test::sliced_block({Style::prusaslicer, 2, 2}).text, thick);
  REQUIRE(!seen.notes.empty());
  CHECK_THAT(seen.notes[0], Catch::Contains("sliced for filament of 1.75 mm") && Catch::Contains("265 %"));
}

}  // namespace unicursal::gcode
