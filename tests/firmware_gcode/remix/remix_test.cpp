#include "firmware_gcode/remix/remix.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <sstream>

#include "core/error.hpp"
#include "firmware_gcode/mixing/chamber.hpp"
#include "tests/firmware_gcode/support/played.hpp"
#include "tests/firmware_gcode/support/sliced_block.hpp"

namespace unicursal::gcode {
namespace {

using test::Block;
using test::BlockBead;
using test::BlockOptions;
using test::Played;
using test::PlayedBead;
using test::Style;

Printer printer_of(double dead, double mixing, const std::string& firmware = "marlin") {
  Printer printer;
  printer.firmware = firmware;
  printer.dead_volume = dead;
  printer.mixing_volume = mixing;
  return printer;
}

RemixSettings settings_for(const SlicedSurvey& survey) {
  RemixSettings settings;
  for (const SlicedTool& tool : survey.tools) {
    Shares shares = Shares::zeros(3);
    shares[static_cast<std::size_t>(tool.number) % 3] = 1;
    settings.tools[tool.number] = settings.materials.size();
    settings.materials.push_back({"T" + std::to_string(tool.number), Mixture(shares)});
  }
  return settings;
}

struct Remixed {
  SlicedSurvey survey;
  std::vector<std::string> lines;
  std::vector<WantedLayer> wanted;
  SeenMixing seen;
  double volume = 0, left_out = 0;
  std::size_t layers = 0;
  double seconds = 0;
};

Remixed remix(
    const std::string& text, const Printer& printer,
    const std::function<void(RemixSettings&)>& change = [](RemixSettings&) {}) {
  std::istringstream first(text), second(text);
  Remixed result;
  result.survey = survey_sliced(first, "part.gcode", printer, {});
  RemixSettings settings = settings_for(result.survey);
  change(settings);
  Remix remix(second, "part.gcode", printer, result.survey, settings);
  remix.listen();
  const auto take = [&](const Chunk& chunk) {
    result.lines.insert(result.lines.end(), chunk.lines.begin(), chunk.lines.end());
    result.volume += chunk.volume;
    result.seconds += chunk.seconds;
    for (const LayerShare& share : chunk.layers) result.layers += share.last ? 1 : 0;
    for (WantedLayer& layer : remix.wanted()) result.wanted.push_back(std::move(layer));
  };
  take(remix.start());
  while (const auto chunk = remix.next()) take(*chunk);
  take(remix.finish(false));
  result.seen = remix.seen();
  result.left_out = remix.left_out();
  return result;
}

constexpr double filament_area = std::numbers::pi / 4 * 1.75 * 1.75;

/// Every vertex of the file occurs, in order, at its speed; what stands between two of them lies on the
/// straight line.
void check_geometry(const std::vector<BlockBead>& file, const std::vector<PlayedBead>& played) {
  std::size_t at = 0;
  for (const BlockBead& bead : file) {
    double filament = 0;
    for (;; ++at) {
      REQUIRE(at < played.size());
      const PlayedBead& piece = played[at];
      filament += piece.filament;
      CHECK(piece.feed == Approx(bead.feed).margin(0.06));
      CHECK(piece.to[2] == Approx(bead.z).margin(1e-5));
      if (std::hypot(piece.to[0] - bead.x, piece.to[1] - bead.y) < 2e-5) break;
      const double dx = bead.x - piece.from[0], dy = bead.y - piece.from[1];
      const double off = std::abs(dx * (piece.to[1] - piece.from[1]) - dy * (piece.to[0] - piece.from[0]));
      CHECK(off / std::hypot(dx, dy) < 1.5e-3);
    }
    ++at;
    CHECK(filament == Approx(bead.filament).margin(2e-5));
  }
  CHECK(at == played.size());
}

double filament_of(const std::vector<BlockBead>& beads) {
  double sum = 0;
  for (const BlockBead& bead : beads) sum += bead.filament;
  return sum;
}

}  // namespace

TEST_CASE("Every vertex of a slicer's file is printed in order and at its speed, and no plastic is lost",
          "[sliced]") {
  const auto style = GENERATE(from_range(std::begin(test::styles), std::end(test::styles)));
  const auto variant = GENERATE(0, 1, 2, 3);
  BlockOptions options{style, 3, 5};
  options.absolute_filament = variant != 1;
  options.relative_positions = variant == 2;
  options.inches = variant == 3;
  CAPTURE(int(style), variant);
  const Block block = test::sliced_block(options);
  const Remixed out = remix(block.text, printer_of(6, 12));
  const Played played = test::play(out.lines);
  check_geometry(block.beads, played.beads);
  const double filament = filament_of(block.beads);
  CHECK(out.volume == Approx(filament * filament_area).epsilon(1e-6));
  double printed = 0;
  for (const PlayedBead& bead : played.beads) printed += bead.filament;
  CHECK(printed == Approx(filament).epsilon(1e-6));
  CHECK(played.drawn == Approx(2).margin(1e-3));
  CHECK(out.survey.layers == 5);
  CHECK(out.layers == 5);
  CHECK(out.survey.changes == 10);
  CHECK(out.survey.extent.min.x() == Approx(40.225).margin(1e-3));
}

TEST_CASE("Filament is drawn back by a tool of equal shares only", "[sliced]") {
  const Block block = test::sliced_block({Style::prusaslicer, 2, 4});
  const Remixed out = remix(block.text, printer_of(2.1, 4));
  const Played played = test::play(out.lines);
  REQUIRE(played.drawing_tools.size() > 20);
  const std::set<int> tools(played.drawing_tools.begin(), played.drawing_tools.end());
  REQUIRE(tools.size() == 1);
  const std::string stored = "M164 S" + std::to_string(*tools.begin());
  const auto at = std::find(out.lines.begin(), out.lines.end(), stored);
  REQUIRE(at - out.lines.begin() >= 3);
  CHECK(*(at - 3) == "M163 S0 P.3334");
  CHECK(*(at - 1) == "M163 S2 P.3333");
  for (const PlayedBead& bead : played.beads) CHECK(bead.tool != *tools.begin());
}

TEST_CASE("Changes fall ahead of walls and into infill", "[sliced]") {
  const auto tools = GENERATE(2, 3);
  const auto chamber = GENERATE(std::pair(2.1, 4.0), std::pair(6.0, 12.0), std::pair(10.0, 25.0));
  CAPTURE(tools, chamber.first);
  BlockOptions options{Style::prusaslicer, tools, 12};
  options.stripe = 20, options.depth = 60, options.infill = 1;
  const Block block = test::sliced_block(options);
  const Printer printer = printer_of(chamber.first, chamber.second);
  const auto part_wrong = [&](bool ahead, bool hide) {
    const Remixed out =
        remix(block.text, printer, [&](RemixSettings& s) { s.look_ahead = ahead, s.hide = hide; });
    return out.seen.misplaced / out.seen.volume;
  };
  const double as_sliced = part_wrong(false, false), hidden = part_wrong(true, true);
  INFO(as_sliced << " " << hidden);
  CHECK(hidden <= std::max(as_sliced / 10, 2e-4));
  if (chamber.first == 6.0) CHECK(hidden <= 0.005);
}

TEST_CASE("The foretold colours are those of an independent chamber", "[sliced]") {
  BlockOptions options{Style::prusaslicer, 3, 6};
  options.infill = 1;
  const Block block = test::sliced_block(options);
  const Printer printer = printer_of(3, 5);
  const Remixed out = remix(block.text, printer);
  // Tanks in series by small explicit steps behind a pipe: crude, and written apart.
  std::vector<std::array<double, 3>> pipe;
  const double tank = ChamberModel{3, 5, 2}.tank_volume(), step = 0.002;
  std::array<std::array<double, 3>, 2> tanks;
  tanks.fill({1.0 / 3, 1.0 / 3, 1.0 / 3});
  pipe.assign(std::size_t(3 / step), {1.0 / 3, 1.0 / 3, 1.0 / 3});
  std::size_t oldest = 0;
  std::map<int, std::array<double, 3>> mixtures;
  std::array<double, 3> shares{};
  for (const std::string& line : out.lines) {
    int a = 0;
    double p = 0;
    if (std::sscanf(line.c_str(), "M163 S%d P%lf", &a, &p) == 2) shares.at(std::size_t(a)) = p;
    if (std::sscanf(line.c_str(), "M164 S%d", &a) == 1) mixtures[a] = shares;
  }
  const Played played = test::play(out.lines);
  double misplaced = 0, seen = 0, owed = 0;
  std::size_t at = 0;
  for (const PlayedBead& bead : played.beads) {
    const BlockBead& file = block.beads.at(at);
    owed += bead.filament * filament_area;
    std::array<double, 3> want{0.02, 0.02, 0.02};
    want.at(std::size_t(file.tool)) = 0.96;
    for (; owed > step; owed -= step) {
      std::array<double, 3> in = pipe[oldest];
      pipe[oldest] = mixtures.at(bead.tool);
      oldest = (oldest + 1) % pipe.size();
      for (auto& content : tanks) {
        for (std::size_t f = 0; f < 3; ++f) content[f] += (in[f] - content[f]) * step / tank;
        in = content;
      }
      if (!is_seen(file.feature)) continue;
      seen += step;
      for (std::size_t f = 0; f < 3; ++f) misplaced += std::abs(in[f] - want[f]) / 2 * step;
    }
    if (std::hypot(bead.to[0] - file.x, bead.to[1] - file.y) < 1e-4) ++at;
  }
  CHECK(out.seen.volume == Approx(seen).epsilon(0.01));
  CHECK(out.seen.misplaced == Approx(misplaced).epsilon(0.05));
}

TEST_CASE("A wipe tower that is left out leaves the part as it was, and travels lead above it", "[sliced]") {
  const bool ramming = GENERATE(false, true), absolute = GENERATE(false, true);
  CAPTURE(ramming, absolute);
  BlockOptions options{Style::prusaslicer, 2, 6};
  options.tower = true;
  options.ramming = ramming;
  options.absolute_filament = absolute;
  const Block block = test::sliced_block(options);
  const Remixed without =
      remix(block.text, printer_of(2.1, 4), [](RemixSettings& s) { s.leave_out_tower = true; });
  const Played played = test::play(without.lines);
  check_geometry(block.beads, played.beads);
  CHECK(without.left_out == Approx(block.tower_filament * filament_area).epsilon(1e-6));
  double printed = 0;
  for (const PlayedBead& bead : played.beads) {
    printed += bead.filament;
    CHECK(bead.to[0] < 100);
  }
  CHECK(printed == Approx(filament_of(block.beads)).epsilon(1e-6));
  // What is drawn back is pushed forward again: nothing is missing, and nothing spills.
  CHECK(played.fed == Approx(printed - played.drawn).margin(1e-3));
  CHECK(played.drawn == Approx(2).margin(1e-3));
  for (const std::string& line : without.lines)
    CHECK(line.find("X180") == std::string::npos);  // nor a way there
  CHECK(without.survey.layers == 6);
  CHECK(without.layers == 6);
  double tower_seconds = 0;
  for (const double seconds : without.survey.tower_seconds) tower_seconds += seconds;
  CHECK(without.seconds == Approx(without.survey.seconds - tower_seconds).epsilon(0.1));
  // With the tower, it is there, and still nothing unloads filament.
  const Remixed with = remix(block.text, printer_of(2.1, 4));
  const Played kept = test::play(with.lines);
  double in_tower = 0, longest = 0;
  for (const PlayedBead& bead : kept.beads) in_tower += bead.to[0] > 100 ? bead.filament : 0;
  CHECK(in_tower == Approx(block.tower_filament).epsilon(1e-6));
  for (const std::string& line : with.lines) {
    double length = 0;
    if (std::sscanf(line.c_str(), "G1 E%lf", &length) == 1) longest = std::max(longest, std::abs(length));
  }
  CHECK(longest <= 4);
}

TEST_CASE("Arcs become chords that lie on the arc", "[sliced]") {
  const std::string head =
      "M104 S210\nM109 S210\nG28\nG90\nM83\n;LAYER_CHANGE\n;Z:0.2\n;HEIGHT:0.2\nG1 X50 Y50 Z0.2 F6000\n"
      ";TYPE:External perimeter\n";
  const auto played = [&](const std::string& arc) {
    return test::play(remix(head + arc + "\nM104 S0\n", printer_of(2.1, 4)).lines).beads;
  };
  const std::string arc =
      GENERATE("G3 X40 Y60 I-10 J0 E1 F1200", "G3 X40 Y60 R10 E1 F1200", "G2 X60 Y60 I10 J0 E1 F1200");
  CAPTURE(arc);
  const auto beads = played(arc);
  REQUIRE(beads.size() > 10);
  const double centre_x = arc[1] == '3' ? 40 : 60, centre_y = 50;
  double filament = 0, length = 0;
  for (const PlayedBead& bead : beads) {
    CHECK(std::hypot(bead.to[0] - centre_x, bead.to[1] - centre_y) == Approx(10).margin(2e-5));
    const double mid =
        std::hypot((bead.to[0] + bead.from[0]) / 2 - centre_x, (bead.to[1] + bead.from[1]) / 2 - centre_y);
    CHECK(mid > 10 - 0.006);
    filament += bead.filament;
    length += std::hypot(bead.to[0] - bead.from[0], bead.to[1] - bead.from[1]);
  }
  CHECK(filament == Approx(1).margin(1e-6));
  CHECK(length == Approx(5 * std::numbers::pi).epsilon(1e-3));
  const auto whole = played("G2 X50 Y50 I5 J0 E2 F1200");
  double around = 0;
  for (const PlayedBead& bead : whole)
    around += std::hypot(bead.to[0] - bead.from[0], bead.to[1] - bead.from[1]);
  CHECK(around == Approx(10 * std::numbers::pi).epsilon(1e-3));
}

TEST_CASE("The end of a print is the file's own, or a park above everything if it was stopped", "[sliced]") {
  const Block block = test::sliced_block({Style::cura, 2, 4});
  const Printer printer = printer_of(2.1, 4);
  const Remixed whole = remix(block.text, printer);
  const auto has = [](const std::vector<std::string>& lines, const std::string& line) {
    return std::find(lines.begin(), lines.end(), line) != lines.end();
  };
  CHECK(has(whole.lines, "G1 Z10.8 F600"));
  CHECK(whole.lines.back() == "M85 S0");
  std::istringstream first(block.text), second(block.text);
  const SlicedSurvey survey = survey_sliced(first, "part.gcode", printer, {});
  Remix stopped(second, "part.gcode", printer, survey, settings_for(survey));
  stopped.start();
  const auto chunk = stopped.next();
  REQUIRE(chunk);
  const Chunk end = stopped.finish(true);
  CHECK(has(end.lines, "G1 Z10.8 F600"));
  CHECK(has(end.lines, "M104 S0"));
  CHECK(has(end.lines, "G1 X0 Y200 F9000"));
  const auto draw = std::find(end.lines.begin(), end.lines.end(), "G1 E-4 F1500");
  REQUIRE(draw != end.lines.end());
  CHECK((draw - 1)->front() == 'T');
}

TEST_CASE("The same file gives the same chunks, and its layers are those that were asked for", "[sliced]") {
  const Block block = test::sliced_block({Style::orcaslicer, 3, 5});
  const Printer printer = printer_of(6, 12, GENERATE("marlin", "repetier", "reprapfirmware"));
  const Remixed a = remix(block.text, printer), b = remix(block.text, printer);
  CHECK(a.lines == b.lines);
  REQUIRE(a.wanted.size() == 5);
  double volume = 0;
  for (std::size_t i = 0; i < a.wanted.size(); ++i) {
    CHECK(a.wanted[i].index == i);
    CHECK(a.wanted[i].top == Approx(0.2 * double(i + 1)));
    CHECK(a.wanted[i].height == Approx(0.2));
    for (const WantedStroke& stroke : a.wanted[i].strokes) {
      volume += stroke.volume;
      CHECK(stroke.width == Approx(0.45).epsilon(0.01));
    }
  }
  CHECK(volume == Approx(filament_of(block.beads) * filament_area).epsilon(1e-6));
}

TEST_CASE("A file that has become shorter since the survey is refused", "[sliced]") {
  const Block block = test::sliced_block({Style::prusaslicer, 2, 4});
  const Printer printer = printer_of(2.1, 4);
  std::istringstream first(block.text), second(block.text.substr(0, block.text.size() / 2));
  const SlicedSurvey survey = survey_sliced(first, "part.gcode", printer, {});
  Remix remix(second, "part.gcode", printer, survey, settings_for(survey));
  remix.start();
  CHECK_THROWS_AS(
      [&] {
        while (remix.next()) {
        }
      }(),
      core::DataError);
}

}  // namespace unicursal::gcode
