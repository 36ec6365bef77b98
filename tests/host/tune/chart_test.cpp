// The chart of `tune colours`: its geometry, its mixtures, and the list of measured colours.
#include "host/tune/chart.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "core/error.hpp"
#include "core/picture/lab.hpp"
#include "host/tune/measured_colours.hpp"
#include "tests/host/support/temp_folder.hpp"

namespace unicursal::host {
namespace {

using core::Vec2;

gcode::Printer printer_with(std::size_t feeders, double nozzle = 0.6) {
  gcode::Printer printer;
  printer.feeders = feeders;
  printer.flow_factors = gcode::PerFeeder::all(feeders, 1);
  printer.nozzle = nozzle;
  printer.bead_width_range = {0.6 * nozzle, 2.5 * nozzle};
  return printer;
}

bool apart(const core::Box& a, const core::Box& b, double by) {
  return a.max.x() + by <= b.min.x() || b.max.x() + by <= a.min.x() || a.max.y() + by <= b.min.y() ||
         b.max.y() + by <= a.min.y();
}

bool inside(const core::Box& box, const Vec2& place) {
  return (place - box.min).minCoeff() >= 0 && (box.max - place).minCoeff() >= 0;
}

std::string complaint(const std::string& list) {
  const test::TempFolder folder;
  try {
    read_measured_colours(folder.write("list.csv", list), 19);
  } catch (const core::DataError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("A chart has every feeder twice and far apart, and mixtures in which each of them takes part") {
  for (const std::size_t feeders : {2U, 3U, 4U, 5U, 6U, 7U, 8U}) {
    CAPTURE(feeders);
    const gcode::Printer printer = printer_with(feeders);
    const Chart chart = make_chart(printer, 0);
    CHECK(chart.patches.size() >= (feeders == 2 ? 11 : 18));
    CHECK(chart.patches.size() <= most_patches);
    std::vector<std::size_t> mixed(feeders);
    for (std::size_t f = 0; f < feeders; ++f) {
      std::vector<std::size_t> alone;
      for (std::size_t i = 0; i < chart.patches.size(); ++i) {
        const ChartPatch& patch = chart.patches[i];
        if (patch.feeder == f) alone.push_back(i);
        if (!patch.feeder && patch.mixture.share(f) > 0.1) ++mixed[f];
        CHECK(patch.mixture.share(f) >= printer.floor_share - 1e-4);
      }
      REQUIRE(alone.size() == 2);
      CHECK(alone[1] - alone[0] >= chart.patches.size() / 3);
      CHECK(chart.patches[alone[0]].mixture.share(f) > 0.8);
    }
    CHECK(*std::min_element(mixed.begin(), mixed.end()) >= 3);
    CHECK(*std::max_element(mixed.begin(), mixed.end()) <= *std::min_element(mixed.begin(), mixed.end()) + 2);
  }
}

TEST_CASE("Patches, numbers and marks keep apart, and before each patch its mixture fills the nozzle") {
  for (const double nozzle : {0.4, 0.6, 0.8}) {
    const gcode::Printer printer = printer_with(3, nozzle);
    const Chart chart = make_chart(printer, 0);
    CAPTURE(nozzle);
    for (std::size_t i = 0; i < chart.patches.size(); ++i) {
      const core::Box& square = chart.patches[i].square;
      CHECK(square.size().minCoeff() >= 8);
      CHECK(chart.patches[i].middle.size().minCoeff() >= 5);
      CHECK(inside({{10, 10}, {190, 190}}, square.min));
      CHECK(inside({{10, 10}, {190, 190}}, square.max));
      for (std::size_t j = 0; j < i; ++j) CHECK(apart(square, chart.patches[j].square, 2));
      const double mark = MarkSizes(chart.print.line_width).ring_outer;
      for (const Vec2& place : chart.marks) {
        const Vec2 half = Vec2::Constant(mark + chart.print.line_width);
        CHECK(apart({place - half, place + half}, square, 0));
        CHECK(inside({{1, 1}, {199, 199}}, place - half));
        CHECK(inside({{1, 1}, {199, 199}}, place + half));
      }
    }
    CHECK(double(chart.print.layers.size()) * chart.print.layer_height >= 0.79);
    for (const TestLayer& layer : chart.print.layers) {
      REQUIRE(layer.beads.size() == 1);
      const TestBead& bead = layer.beads.front();
      std::vector<double> purged(chart.patches.size()), laid(chart.patches.size());
      Vec2 here = bead.start;
      for (const TestMove& move : bead.moves) {
        const Vec2 middle = (here + move.to) / 2;
        const bool within = inside(chart.patches[move.mixture].square, middle);
        (within ? laid : purged)[move.mixture] += laid[move.mixture] > 0 && !within ? 0 : move.volume;
        for (std::size_t other = 0; other < chart.patches.size(); ++other)
          if (other != move.mixture) CHECK_FALSE(inside(chart.patches[other].middle, middle));
        here = move.to;
      }
      for (std::size_t i = 0; i < chart.patches.size(); ++i) {
        CHECK(purged[i] >= 1.45 * (printer.dead_volume + printer.mixing_volume));
        // Lines that touch: the square is full, and has the way up to the next row at its side.
        CHECK(laid[i] == Approx(100 * chart.print.layer_height).epsilon(0.25));
      }
    }
  }
}

TEST_CASE("A chart that does not fit is refused") {
  gcode::Printer printer = printer_with(3);
  printer.bed = {90, 60, 100};
  CHECK_THROWS_WITH(make_chart(printer, 0), Catch::Contains("printer.bed") && Catch::Contains("19 patches"));
  printer = printer_with(8);
  printer.dead_volume = 500;
  CHECK_THROWS_WITH(make_chart(printer, 0), Catch::Contains("transition.dead_volume"));
}

TEST_CASE("With more mixtures than virtual tools, the G-code defines tools again before they are used") {
  const gcode::Printer printer = printer_with(4);
  const Chart chart = make_chart(printer, 2);
  REQUIRE(chart.patches.size() > 15);
  const FinishedPrint print = gcode_of(chart.print, printer);
  CHECK(print.body.size() == 4);
  // What the firmware holds: M163 collects shares, M164 stores them.
  std::vector<double> shares(4);
  std::vector<std::vector<double>> tools(16);
  std::vector<std::vector<double>> used;
  const auto run = [&](const gcode::Chunk& chunk) {
    for (const std::string& line : chunk.lines) {
      std::size_t number = 0;
      double share = 0;
      if (std::sscanf(line.c_str(), "M163 S%zu P%lf", &number, &share) == 2) shares.at(number) = share;
      if (std::sscanf(line.c_str(), "M164 S%zu", &number) == 1) tools.at(number) = shares;
      if (std::sscanf(line.c_str(), "T%zu", &number) == 1) used.push_back(tools.at(number));
    }
  };
  run(print.start);
  run(print.body[0]);
  std::size_t next = 0;
  for (const auto& tool : used) {
    if (next == chart.patches.size()) break;
    REQUIRE(tool.size() == 4);
    bool same = true;
    for (std::size_t f = 0; f < 4; ++f)
      same = same && std::abs(tool[f] - chart.patches[next].mixture.share(f)) < 1e-6;
    if (same) ++next;
  }
  CHECK(next == chart.patches.size());  // all of them, in their order
}

TEST_CASE("Measured colours are read as numbers of Lab or as people write colours") {
  const test::TempFolder folder;
  const auto seen = read_measured_colours(
      folder.write("list.csv", "patch;L;a;b\r\n3; 47.5; 12.25; -40\r\n\r\n\"1\",\"#E0604a\"\n19\t100\t0\t0"),
      19);
  REQUIRE(seen.size() == 3);
  CHECK(seen[0].patch == 2);
  CHECK(picture::lab_of(seen[0].light).b == Approx(-40));
  CHECK(picture::colour_of(seen[1].light) == picture::Colour{0xe0, 0x60, 0x4a});
  CHECK(seen[2].patch == 18);
  CHECK_THROWS_AS(read_measured_colours(folder / "none.csv", 19), core::FileError);
  CHECK_THROWS_AS(read_measured_colours(folder.path(), 19), core::FileError);
}

TEST_CASE("A mistake in a list of colours is reported with its line") {
  CHECK_THAT(complaint("1,#ffffff\n20,#ffffff\n"), Catch::Contains("line 2") && Catch::Contains("1 to 19"));
  CHECK_THAT(complaint("0,#ffffff\n"), Catch::Contains("line 1") && Catch::Contains("patch 0"));
  CHECK_THAT(complaint("nan,#ffffff\n"), Catch::Contains("line 1"));
  CHECK_THAT(complaint("1.5,#ffffff\n"), Catch::Contains("patch 1.5"));
  CHECK_THAT(complaint("1,#ffffff\n\n1,#fffffe\n"),
             Catch::Contains("line 3") && Catch::Contains("second time"));
  CHECK_THAT(complaint("1,#ffffff\nx,#ffffff\n"),
             Catch::Contains("line 2") && Catch::Contains("number of a patch"));
  for (const char* colour :
       {"", "red", "#fffff", "1,2", "50,0,0,0", "101,0,0", "50,1e9,0", "50,0,nan", "50,0,"})
    CHECK_THAT(complaint(std::string("1,") + colour), Catch::Contains("no colour that can be read"));
}

}  // namespace unicursal::host
