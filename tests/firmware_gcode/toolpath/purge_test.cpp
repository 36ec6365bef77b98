// The beginning of the prime line, in which each feeder purges its inlet.
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <set>

#include "firmware_gcode/toolpath/encoder.hpp"
#include "firmware_gcode/toolpath/prime_line.hpp"

using namespace unicursal;
using namespace unicursal::gcode;

namespace {

constexpr double nominal_area = std::numbers::pi / 4 * 1.75 * 1.75;

Printer purging(const std::string& firmware = "marlin") {
  Printer printer;
  printer.firmware = firmware;
  printer.purge_inlets = true;
  return printer;
}

/// `colours` materials, the first of which is laid.
PrintSettings job_of(std::size_t colours) {
  PrintSettings settings;
  for (std::size_t i = 0; i < colours; ++i) {
    const double part = static_cast<double>(i + 1) / static_cast<double>(colours + 1);
    settings.materials.push_back({"colour " + std::to_string(i), Mixture({part, 1 - part, 0})});
  }
  settings.zone_materials = {0};
  settings.extent = {{60, 60}, {140, 140}};
  settings.part_height = 10;
  return settings;
}

PlacedLayer square() {
  core::BeadPath path;
  path.beads = {{{80, 80}, 20.0, 0}, {{100, 80}, 20.0, 0}, {{100, 100}, 20.0, 0}, {{80, 100}, 20.0, 0}};
  return {0, 0.2, 0.2, {path}};
}

/// The number behind a letter in a line; 0 without one.
double value_in(const std::string& line, char letter) {
  const auto at = line.find(std::string(" ") + letter);
  return at == std::string::npos ? 0 : std::strtod(line.c_str() + at + 2, nullptr);
}

/// Plays lines as each of the firmwares does: what every feeder has pushed out along beads, mm³.
struct Firmware {
  std::array<double, 3> pushed{}, collected{};
  std::array<std::array<double, 3>, 16> tools{};
  std::array<double, 3> shares{};
  int used = -1, highest = -1;
  bool live = false;  ///< M163 acts at once, as in Repetier

  std::array<double, 3> mixed() const {
    const double sum = collected[0] + collected[1] + collected[2];
    return {collected[0] / sum, collected[1] / sum, collected[2] / sum};
  }

  void run(const std::string& line) {
    if (line.starts_with("M163")) {
      collected.at(static_cast<std::size_t>(value_in(line, 'S'))) = value_in(line, 'P');
      if (live) shares = mixed();
    }
    if (line.starts_with("M164")) {
      const int tool = static_cast<int>(value_in(line, 'S'));
      CHECK(tool != used);  // never the one in use
      highest = std::max(highest, tool);
      tools.at(static_cast<std::size_t>(tool)) = mixed();
    }
    if (line.starts_with("M567")) {
      const char* at = line.c_str() + line.find('E');
      for (double& share : shares) {
        char* end = nullptr;
        share = std::strtod(at + 1, &end);
        at = end;
      }
    } else if (line.front() == 'T') {
      const int tool = std::atoi(line.c_str() + 1);
      if (highest >= 0) used = tool, shares = tools.at(static_cast<std::size_t>(tool));
    }
    const bool bead = line.starts_with("G1 X") || line.starts_with("G1 Y");
    for (std::size_t f = 0; bead && f < 3; ++f) pushed[f] += value_in(line, 'E') * shares[f] * nominal_area;
  }
};

}  // namespace

TEST_CASE("the prime line holds a purge of each feeder besides what fills the nozzle") {
  Printer printer = purging();
  const core::Box part{{80, 80}, {120, 120}};
  const auto line = prime_line(printer, part, 0.2);
  REQUIRE(line);
  CHECK(line->purge == 4);
  CHECK(line->volume == Approx(2 * 6.1 + 3 * 4));
  CHECK(line->volume == Approx((line->to - line->from).norm() * line->width * 0.2));
  printer.feeders = 6;
  CHECK(prime_line(printer, part, 0.2)->volume == Approx(2 * 6.1 + 6 * 4));
  printer.purge_inlets = false;
  CHECK(prime_line(printer, part, 0.2)->purge == 0);
  CHECK(prime_line(printer, part, 0.2)->volume == Approx(2 * 6.1));
}

TEST_CASE("on a short edge the purges are smaller, and the nozzle is filled all the same") {
  Printer printer = purging();
  const core::Box part{{40, 40}, {60, 60}};
  printer.bed = {100, 100, 100};
  const auto tight = prime_line(printer, part, 0.2);  // at most 90 x 1 x 0.2 mm
  REQUIRE(tight);
  CHECK(tight->purge == Approx((90 * 0.2 - 2 * 6.1) / 3));
  CHECK(tight->volume == Approx(90 * 0.2));
  printer.bed = {70, 70, 100};
  const auto tiny = prime_line(printer, {{30, 30}, {40, 40}}, 0.2);
  REQUIRE(tiny);
  CHECK(tiny->purge == 0);
  CHECK(tiny->volume == Approx(60 * 0.2));
}

TEST_CASE(
    "every feeder has pushed its purge out before the part, in every dialect, with the print's own tools") {
  const auto [firmware, colours] = GENERATE(table<std::string, std::size_t>({{"marlin", 1},
                                                                             {"marlin", 2},
                                                                             {"marlin", 15},
                                                                             {"marlin", 16},
                                                                             {"repetier", 2},
                                                                             {"reprapfirmware", 2}}));
  CAPTURE(firmware, colours);
  Encoder encoder(purging(firmware), job_of(colours));
  Firmware printer;
  printer.live = firmware == "repetier";
  for (const std::string& line : encoder.start().lines) printer.run(line);
  const int tools = printer.highest;
  const auto before = printer.tools;
  Chunk chunk = encoder.layer(square());
  const Chunk rest = encoder.rest();
  std::vector<std::string> lines = chunk.lines;
  lines.insert(lines.end(), rest.lines.begin(), rest.lines.end());
  std::array<double, 3> purged{};
  for (const std::string& line : lines) {
    if (line == ";TYPE:Solid infill") purged = printer.pushed;
    printer.run(line);
  }
  double primed = 0;
  const Mixture first = encoder.intended(0);
  for (std::size_t f = 0; f < 3; ++f) {
    CHECK(purged[f] == Approx(4 * (0.8 + 0.1 + 0.1) + 2 * 6.1 * first.share(f)).margin(0.03));
    primed += purged[f];
  }
  CHECK(printer.highest == tools);
  CHECK(printer.tools == before);
  double mixed = 0, aside = 0;
  for (const Chunk* each : {&std::as_const(chunk), &rest}) {
    for (const auto& [mixture, volume] : each->mixture_volumes) mixed += volume;
    for (const auto& [mixture, volume] : each->aside_mixtures) aside += volume;
  }
  CHECK(chunk.prime_volume + rest.prime_volume == Approx(primed).epsilon(1e-4));
  CHECK(aside == Approx(primed).epsilon(1e-4));
  CHECK(mixed == Approx(chunk.volume + rest.volume));
  CHECK(mixed == Approx(primed + 80 * 0.2).epsilon(1e-4));
}
