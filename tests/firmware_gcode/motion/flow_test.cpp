#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <sstream>

#include "firmware_gcode/motion/held_flow.hpp"
#include "firmware_gcode/motion/laying_speed.hpp"
#include "firmware_gcode/route/simplify.hpp"
#include "firmware_gcode/toolpath/encoder.hpp"

using namespace unicursal;
using namespace unicursal::gcode;

namespace {

/// Hairpins of `spacing` between lines of `length` mm, their ends rounded by `chords` pieces, all 0.45 mm
/// wide.
PlacedLayer folds(double length, double spacing = 0.45, int chords = 4) {
  core::BeadPath path;
  const double radius = spacing / 2;
  for (int line = 0; line < 30; ++line) {
    const double y = 50 + spacing * line;
    const bool right = line % 2 == 0;
    for (int k = 0; k <= 20; ++k) {
      const double part = right ? k / 20.0 : 1 - k / 20.0;
      path.beads.push_back({core::Vec2(50 + length * part, y), 0.0, 0});
    }
    for (int k = 1; k < chords; ++k) {
      const double angle = std::numbers::pi * k / chords;
      path.beads.push_back(
          {core::Vec2(right ? 50 + length + radius * std::sin(angle) : 50 - radius * std::sin(angle),
                      y + radius - radius * std::cos(angle)),
           0.0, 0});
    }
  }
  for (std::size_t i = 0; i < path.size(); ++i) path.beads[i].area = 0.45 * path.length(i);
  return {3, 0.8, 0.2, {path}};
}

PrintSettings one_colour() {
  PrintSettings settings;
  settings.materials = {{"grey", Mixture({1, 1, 1})}};
  settings.zone_materials = {0};
  return settings;
}

}  // namespace

TEST_CASE("the sustained flow is sustained, and a little more is not") {
  const Printer printer;
  for (const double length : {2.0, 5.0, 20.0}) {
    const std::vector<PlacedLayer> layers = {folds(length)};
    const double flow = held_flow(layers, one_colour(), printer);
    INFO(length << " mm: " << flow);
    CHECK(flow < printer.max_flow);
    CHECK(flow > 0.3);
    CHECK(share_held(layers, one_colour(), printer, flow) >= held_share);
    CHECK(share_held(layers, one_colour(), printer, flow + 0.02) < held_share);
  }
}

TEST_CASE("more acceleration, longer lines and thicker layers sustain more flow") {
  Printer printer;
  const double flow = held_flow({folds(3)}, one_colour(), printer);
  CHECK(held_flow({folds(9)}, one_colour(), printer) > flow);
  PrintSettings thick = one_colour();
  thick.layer_height = 0.4;  // equal speeds: twice the height, twice the flow
  CHECK(held_flow({folds(3)}, thick, printer) == Approx(2 * flow).margin(0.03));
  printer.max_acceleration = {4000, 4000, 100};
  printer.motion.acceleration = 4000;
  CHECK(held_flow({folds(3)}, one_colour(), printer) > 1.1 * flow);
}

TEST_CASE("the sustained flow never exceeds what the extruder melts, and empty layers give that") {
  Printer printer;
  printer.max_flow = 0.7;
  CHECK(held_flow({folds(20)}, one_colour(), printer) == 0.7);
  CHECK(held_flow({}, one_colour(), printer) == 0.7);
}

namespace {

/// The greatest flow in the lines of a layer of the part, mm³/s.
double flow_asked(const Chunk& chunk, std::size_t layer) {
  double x = 0, y = 0, speed = 0, greatest = 0;
  std::size_t at = 0;
  for (const std::string& line : chunk.lines) {
    if (line == ";LAYER_CHANGE") ++at;
    if (!line.starts_with("G1 ") && !line.starts_with("G0 ")) continue;
    double filament = 0;
    const double x0 = x, y0 = y;
    std::istringstream words(line.substr(3));
    for (std::string word; words >> word;) {
      const double value = std::stod(word.substr(1));
      if (word[0] == 'X') x = value;
      if (word[0] == 'Y') y = value;
      if (word[0] == 'F') speed = value / 60;
      if (word[0] == 'E') filament = value;
    }
    const double way = std::hypot(x - x0, y - y0);
    const bool long_enough = way > 0.1;                                 // E is rounded
    const bool in_part = std::min(x0, x) > 48 && std::min(y0, y) > 48;  // excludes the prime line
    if (at != layer + 1 || !long_enough || filament <= 0 || !in_part) continue;
    greatest = std::max(greatest, filament * std::numbers::pi / 4 * 1.75 * 1.75 / (way / speed));
  }
  return greatest;
}

Chunk printed(const std::vector<double>& lengths, const PrintSettings& settings, double& flow) {
  Encoder encoder({}, settings);
  Chunk all;
  const auto keep = [&all](const Chunk& chunk) {
    all.lines.insert(all.lines.end(), chunk.lines.begin(), chunk.lines.end());
    all.warnings.insert(all.warnings.end(), chunk.warnings.begin(), chunk.warnings.end());
  };
  encoder.start();
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    PlacedLayer layer = folds(lengths[i]);
    layer.index = i, layer.top = 0.2 * static_cast<double>(i + 1);
    keep(encoder.layer(layer));
  }
  keep(encoder.rest());
  flow = encoder.flow();
  return all;
}

}  // namespace

TEST_CASE("all layers sustain an automatic flow, also those that were unknown at the beginning") {
  PrintSettings settings = one_colour();
  settings.automatic_flow = true;
  settings.extent = {{45, 45}, {95, 70}};
  const auto held = [&](double length) { return held_flow({simplified(folds(length))}, settings, {}); };
  REQUIRE(held(3) < 0.9 * held(20));
  double flow = 0;
  // The second layer has short lines; it is in the window from which the flow is chosen.
  const Chunk early = printed({20, 3, 20, 20, 20, 20}, settings, flow);
  CHECK(flow == held(3));
  CHECK(early.warnings.empty());
  // The seventh layer is not in the window.
  const Chunk late = printed({20, 20, 20, 20, 20, 20, 3, 20}, settings, flow);
  CHECK(flow == held(20));
  CHECK(flow_asked(late, 5) == Approx(held(20)).epsilon(0.03));
  CHECK(flow_asked(late, 6) == Approx(held(3)).epsilon(0.03));
  CHECK(flow_asked(late, 7) == Approx(held(20)).epsilon(0.03));
  REQUIRE(late.warnings.size() == 1);
  CHECK(late.warnings.front().find("layer 6") != std::string::npos);
}

TEST_CASE("an automatic flow is chosen at the first layer with beads, and then kept") {
  PrintSettings settings = one_colour();
  settings.automatic_flow = true;
  settings.horizon = 1;
  settings.extent = {{45, 45}, {60, 70}};
  Encoder encoder({}, settings);
  encoder.start();
  PlacedLayer layer = folds(3);
  layer.index = 0, layer.top = 0.2;
  encoder.layer(layer);
  const double flow = encoder.flow();
  CHECK(flow == held_flow({simplified(layer)}, settings, {}));
  layer = folds(40);
  layer.index = 1, layer.top = 0.4;
  encoder.layer(layer);
  CHECK(encoder.flow() == flow);
}

TEST_CASE("a constant speed respects the melting limit and slows down on the first layer") {
  PrintSettings settings = one_colour();
  settings.speed = 20;
  settings.first_layer_speed = 0.5;
  const LayingSpeed pace({}, settings);
  CHECK(pace.speed({1, 1}, 0.1, 1, 0.2) == Approx(20));
  CHECK(pace.speed({1, 1}, 0.1, 0, 0.2) == Approx(10));
  CHECK(pace.speed({1, 0}, 1, 1, 0.2) == Approx(8));  // 1 mm³ on 1 mm, 8 mm³/s at most
}
