#include "host/tune/strip.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <sstream>

#include "core/error.hpp"
#include "host/tune/strip_print.hpp"
#include "host/tune/strip_sizes.hpp"

namespace unicursal::host {
namespace {

using core::Vec2;

gcode::Printer printer_with(double nozzle, double bed_x = 200, double bed_y = 200) {
  gcode::Printer printer;
  printer.nozzle = nozzle;
  printer.bead_width_range = {0.6 * nozzle, 2.5 * nozzle};
  printer.bed = {bed_x, bed_y, 200};
  return printer;
}

double distance_to_bead(const Strip& strip, const Vec2& place) {
  double least = std::numeric_limits<double>::infinity();
  Vec2 here = strip.start;
  for (const StripMove& move : strip.bead) {
    least = std::min(least, core::distance_to_segment(place, here, move.to));
    here = move.to;
  }
  return least;
}

double distance_of_segments(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  return std::min({core::distance_to_segment(a, c, d), core::distance_to_segment(b, c, d),
                   core::distance_to_segment(c, a, b), core::distance_to_segment(d, a, b)});
}

}  // namespace

TEST_CASE("Nothing on the strip overlaps, and all of it is on the bed") {
  for (const double nozzle : {0.4, 0.6, 0.8}) {
    for (const double bed : {150.0, 200.0, 300.0}) {
      CAPTURE(nozzle, bed);
      const gcode::Printer printer = printer_with(nozzle, bed, bed);
      const StripSizes sizes(printer);
      const Strip strip = make_strip(printer, {});
      for (const auto& line : strip.marks) {
        for (const Vec2& corner : line) {
          CHECK(corner.minCoeff() > 1);
          CHECK(corner.maxCoeff() < bed - 1);
          CHECK(distance_to_bead(strip, corner) > sizes.fat_width / 2 + sizes.line / 2 + 0.2);
        }
      }
      // Straight strokes keep apart from each other: all ticks, and of the digits 1, 3 and 4.
      for (std::size_t i = 0; i < strip.marks.size(); ++i) {
        for (std::size_t j = i + 1; j < strip.marks.size(); ++j) {
          if (strip.marks[i].size() > 2 || strip.marks[j].size() > 2) continue;
          const auto &a = strip.marks[i], &b = strip.marks[j];
          CHECK(distance_of_segments(a[0], a[1], b[0], b[1]) > 1.2 * nozzle);
        }
      }
    }
  }
}

TEST_CASE("A tick is worth no more than its share of what has passed, and the books balance") {
  for (const double nozzle : {0.4, 0.6}) {
    const gcode::Printer printer = printer_with(nozzle);
    const StripSizes sizes(printer);
    const Strip strip = make_strip(printer, {});
    double after_switch = 0;
    // The line of 100 % is laid before the strip, and lanes of the first mixture lie between.
    for (const StripMove& move : strip.bead)
      after_switch = move.shade == Shade::to ? after_switch + move.volume : 0;
    CHECK(after_switch == Approx(strip.volume()));
    CHECK(strip.volume() >= 60);
    CHECK(strip.points.front().passed == 0);
    for (std::size_t i = 1; i < strip.points.size(); ++i) {
      const double worth = strip.points[i].passed - strip.points[i - 1].passed;
      CHECK(worth <= std::max(0.02 * strip.points[i].passed, sizes.thin * strip.tick) + 1e-12);
      CHECK((strip.points[i].place - strip.points[i - 1].place).norm() == Approx(strip.tick));
    }
    // Every tick is printed but odd ones in turns and those that a turn leaves no room for.
    CHECK(strip.marked.size() + 20 > strip.points.size() * 9 / 10);
    for (std::size_t i = 1; i < strip.marked.size(); ++i) {
      CHECK(strip.marked[i] - strip.marked[i - 1] <= 3);
      CHECK(strip.marked[i] > strip.marked[i - 1]);
    }
  }
}

TEST_CASE("The nozzle is filled before each reference line and before the strip") {
  const Strip strip = make_strip(printer_with(0.6), {});
  std::array<double, shade_count> filled{};
  for (const StripMove& move : strip.bead) filled[static_cast<std::size_t>(move.shade)] += move.volume;
  for (std::size_t shade = 0; shade + 1 < shade_count; ++shade) CHECK(filled[shade] > strip.volume());
}

TEST_CASE("A range that does not fit is refused, without one, the strip is made as large as fits") {
  CHECK(make_strip(printer_with(0.6, 120, 110), {}).volume() < 60);
  CHECK_THROWS_AS(make_strip(printer_with(0.6, 120, 110), 100.0), core::DataError);
  CHECK_THROWS_AS(make_strip(printer_with(0.6, 80, 80), {}), core::DataError);
  CHECK(make_strip(printer_with(0.6, 300, 300), 120.0).volume() >= 120);
}

TEST_CASE("The G-code switches at tick 0, lays the bead in one go and feeds the volumes of the strip") {
  const gcode::Printer printer = printer_with(0.6);
  const Strip strip = make_strip(printer, {});
  const FinishedPrint print = strip_print(strip, printer, {2, 0});
  REQUIRE(print.body.size() == 1);
  Vec2 here(0, 0), switched(-1, -1);
  double fed_after = 0;
  bool in_bead = false;
  for (const std::string& line : print.body.front().lines) {
    if (line == ";TYPE:Solid infill") in_bead = true;
    if (line == "T4") switched = here, fed_after = 0;  // the last switch is that of tick 0
    if (in_bead) CHECK(line.find(" E-") == std::string::npos);
    if (line.front() != 'G') continue;
    std::istringstream words(line);
    for (std::string word; words >> word;) {
      if (word[0] == 'X') here.x() = std::stod(word.substr(1));
      if (word[0] == 'Y') here.y() = std::stod(word.substr(1));
      if (word[0] == 'E' && switched.x() >= 0) fed_after += std::stod(word.substr(1));
    }
    CHECK(here.minCoeff() >= 0);
    CHECK(here.maxCoeff() <= 200);
  }
  CHECK((switched - strip.points.front().place).norm() < 1e-3);
  const double area = std::numbers::pi / 4 * printer.filament_diameter * printer.filament_diameter;
  CHECK(fed_after * area == Approx(strip.volume()).epsilon(1e-4));
}

TEST_CASE("The reference mixtures lie on the way from the first to the second") {
  const auto mixtures = strip_mixtures(printer_with(0.6), {0, 1});
  const double from = mixtures[0].share(1), way = mixtures[4].share(1) - from;
  CHECK(way > 0.9);
  CHECK((mixtures[1].share(1) - from) / way == Approx(0.05).margin(2e-4));
  CHECK((mixtures[2].share(1) - from) / way == Approx(0.5).margin(2e-4));
  CHECK((mixtures[3].share(1) - from) / way == Approx(0.95).margin(2e-4));
  for (const gcode::Mixture& mixture : mixtures) CHECK(mixture.share(2) == Approx(0.02).margin(1e-4));
}

}  // namespace unicursal::host
