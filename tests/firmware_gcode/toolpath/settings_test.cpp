// Settings that users of slicers expect, and their effect on the lines.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "firmware_gcode/toolpath/encoder.hpp"
#include "firmware_gcode/toolpath/job_frame.hpp"

using namespace unicursal;
using namespace unicursal::gcode;

namespace {

PrintSettings plain() {
  PrintSettings settings;
  settings.materials = {{"grey", Mixture({1, 1, 1})}};
  settings.zone_materials = {0};
  settings.extent = {{80, 80}, {120, 120}};
  settings.layer_count = 3;
  settings.horizon = 1;  // every layer is returned at once
  settings.look_ahead = false;
  return settings;
}

PlacedLayer ring(std::size_t index, const core::Vec2& center = {100, 100}) {
  core::BeadPath path;
  for (int i = 0; i < 60; ++i) {
    const double angle = std::numbers::pi * i / 30;
    path.beads.push_back({center + 20 * core::Vec2(std::cos(angle), std::sin(angle)), 0.0, 0});
  }
  for (std::size_t i = 0; i < path.size(); ++i) path.beads[i].area = 0.5 * path.length(i);
  return {index, 0.2 * static_cast<double>(index + 1), 0.2, {path}};
}

std::size_t count(const Chunk& chunk, const std::string& line) {
  return static_cast<std::size_t>(std::count(chunk.lines.begin(), chunk.lines.end(), line));
}

bool holds(const Chunk& chunk, const std::string& part) {
  return std::any_of(chunk.lines.begin(), chunk.lines.end(),
                     [&](const auto& line) { return line.find(part) != std::string::npos; });
}

}  // namespace

TEST_CASE("fan and heaters change with their layer, and the first layer is warm when it begins") {
  PrintSettings settings = plain();
  settings.fan = {40, 1};
  settings.temperatures = {{0, 215.0, 70.0}, {2, 200.0, {}}};
  Encoder encoder({}, settings);
  const Chunk start = encoder.start();
  CHECK(count(start, "M109 S215") == 1);
  CHECK(count(start, "M190 S70") == 1);
  const Chunk first = encoder.layer(ring(0)), second = encoder.layer(ring(1)), third = encoder.layer(ring(2));
  CHECK_FALSE(holds(first, "M106"));
  CHECK(count(second, "M106 S102") == 1);  // 40 % of 255
  CHECK_FALSE(holds(first, "M104"));
  CHECK(count(third, "M104 S200") == 1);
  CHECK_FALSE(holds(third, "M140"));
  CHECK_FALSE(holds(third, "M106"));
  CHECK(count(encoder.finish(), "M107") == 1);
}

TEST_CASE("the nozzle is lifted on a travel and comes down again") {
  Printer printer;
  printer.z_hop = 0.5;
  Encoder encoder(printer, plain());
  encoder.start();
  PlacedLayer two = ring(0, {70, 100});
  two.paths.push_back(ring(0, {130, 100}).paths[0]);
  const Chunk chunk = encoder.layer(two);
  CHECK(count(chunk, "G1 Z.7 F600") + count(chunk, "G1 Z.7") == 3);  // to the prime line, and to either ring
  CHECK(count(chunk, "G1 Z.2 F600") + count(chunk, "G1 Z.2") == 3);
}

TEST_CASE("the skirt precedes the part, is counted, and the prime line keeps clear of it") {
  PrintSettings settings = plain();
  Encoder bare({}, settings);
  bare.start();
  const Chunk without = bare.layer(ring(0));
  settings.skirt = {2, 6};
  Encoder encoder({}, settings);
  encoder.start();
  const Chunk chunk = encoder.layer(ring(0));
  const auto at = [&](const char* line) { return std::find(chunk.lines.begin(), chunk.lines.end(), line); };
  CHECK(at(";TYPE:Custom") < at(";TYPE:Skirt"));
  CHECK(at(";TYPE:Skirt") < at(";TYPE:Solid infill"));
  CHECK(at(";TYPE:Solid infill") != chunk.lines.end());
  // Two rings of radius 20 + 6 + 0.5 and + 1, 0.5 mm wide and 0.2 mm high
  const double rings = 2 * std::numbers::pi * (26.5 + 27) * 0.5 * 0.2;
  CHECK(chunk.prime_volume - without.prime_volume == Approx(rings).epsilon(0.01));
  CHECK(chunk.volume - chunk.prime_volume == Approx(without.volume - without.prime_volume));
  CHECK_FALSE(holds(encoder.layer(ring(1)), ";TYPE:Skirt"));
}

TEST_CASE("a skirt without room causes a warning") {
  Printer printer;
  printer.bed = {42, 42, 50};
  PrintSettings settings = plain();
  settings.extent = {{1, 1}, {41, 41}};
  settings.skirt = {1, 5};
  Encoder encoder(printer, settings);
  encoder.start();
  const Chunk chunk = encoder.layer(ring(0, {21, 21}));
  CHECK(std::any_of(chunk.warnings.begin(), chunk.warnings.end(),
                    [](const auto& w) { return w.find("no skirt") != std::string::npos; }));
}

TEST_CASE("a slower first layer takes proportionally longer") {
  PrintSettings settings = plain();
  settings.flow = 1;
  Encoder fast({}, settings);
  settings.first_layer_speed = 0.5;
  Encoder slow({}, settings);
  fast.start(), slow.start();
  const double first = fast.layer(ring(0)).seconds;
  CHECK(slow.layer(ring(0)).seconds == Approx(2 * first).epsilon(0.1));  // travels are as fast as before
  CHECK(slow.layer(ring(1)).seconds == Approx(fast.layer(ring(1)).seconds).epsilon(1e-2));
}

TEST_CASE("the seconds of chunks are those of their beads at the requested flow, and add up") {
  Encoder encoder({}, plain());
  double sum = encoder.start().seconds, volume = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Chunk chunk = encoder.layer(ring(i));
    sum += chunk.seconds;
    volume += chunk.volume;
  }
  const double laying = encoder.laying_seconds();
  CHECK(laying > volume / 2);      // 2 mm³/s
  CHECK(laying < volume / 2 + 2);  // and the way from the prime line
  CHECK(sum > laying);
  CHECK(sum < laying + 10);  // the way to the prime line and from there to the part
}

TEST_CASE("steps and factors of the feeders reach the firmware") {
  Printer printer;
  printer.extruder_steps = 412.5;
  printer.flow_factors = {1.1, 1, 1};
  PrintSettings settings = plain();
  settings.materials = {{"first", Mixture({1, 0, 0})}};
  Encoder encoder(printer, settings);
  CHECK(count(encoder.start(), "M92 E412.5") == 1);
  const Chunk chunk = encoder.layer(ring(0));
  double written = 0;
  for (const std::string& line : chunk.lines) {
    const auto e = line.find(" E");
    if (line.starts_with("G1 X") || line.starts_with("G1 Y")) {
      if (e != std::string::npos) written += std::stod(line.substr(e + 2));
    }
  }
  const double filament = chunk.volume / (std::numbers::pi / 4 * 1.75 * 1.75);
  const double share = encoder.intended(0).share(0);
  CHECK(written / filament == Approx(share * 1.1 + (1 - share)).epsilon(1e-4));
}

TEST_CASE("the same beads in Repetier's dialect: other tools, the same E") {
  Printer printer;
  const auto moves = [&](const char* firmware) {
    printer.firmware = firmware;
    Encoder encoder(printer, plain());
    encoder.start();
    std::vector<std::string> lines = encoder.layer(ring(0)).lines;
    return lines;
  };
  CHECK(moves("marlin") == moves("repetier"));
  printer.firmware = "repetier";
  Encoder encoder(printer, plain());
  const Chunk start = encoder.start();
  CHECK(count(start, ";FLAVOR:Repetier") == 1);
  CHECK(count(start, "M163 S0 P34") == 2);  // the material and the retraction tool
  CHECK(count(start, "M400") == 2);
}

TEST_CASE("the same beads in RepRapFirmware's dialect: one tool, the same moves") {
  Printer printer;
  const auto moves = [&](const char* firmware) {
    printer.firmware = firmware;
    Encoder encoder(printer, plain());
    encoder.start();
    std::vector<std::string> lines = encoder.layer(ring(0)).lines;
    std::erase_if(lines, [](const std::string& line) { return line[0] == 'T' || line.starts_with("M567"); });
    return lines;
  };
  CHECK(moves("marlin") == moves("reprapfirmware"));
  printer.firmware = "reprapfirmware";
  printer.start_gcode = "T1";  // which the print must not keep
  Encoder encoder(printer, plain());
  const Chunk start = encoder.start();
  CHECK(count(start, ";FLAVOR:RepRap") == 1);
  CHECK(count(start, "T0 P0") == 2);  // before the heat, and behind the user's own lines
  CHECK(count(start, "M163") == 0);
  CHECK(start.lines.back() == "M567 P0 E.3334:.3333:.3333");
}

TEST_CASE("the user's own lines may contain placeholders, and forbidden lines are refused") {
  Printer printer;
  printer.start_gcode = "M117 {layer_count} layers\n";
  Encoder encoder(printer, plain());
  const Chunk start = encoder.start();
  CHECK(count(start, "M117 3 layers") == 1);
  CHECK(count(start, user_lines_begin) == 1);
  printer.start_gcode = "M117 {layers}";
  CHECK_THROWS_WITH(Encoder(printer, plain()), Catch::Contains("gcode.start") && Catch::Contains("{layers}"));
}
