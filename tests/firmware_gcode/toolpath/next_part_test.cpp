// Parts that are printed one after the other: the way from one to the next, and how the next begins.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <optional>

#include "firmware_gcode/interruption/pause.hpp"
#include "firmware_gcode/toolpath/encoder.hpp"

using namespace unicursal;
using namespace unicursal::gcode;

namespace {

constexpr double layer_height = 0.25;

core::BeadPath square_at(const core::Vec2& corner) {
  core::BeadPath path;
  for (const core::Vec2& p : {core::Vec2(0, 0), core::Vec2(20, 0), core::Vec2(20, 20), core::Vec2(0, 20)})
    path.beads.push_back({corner + p, 20, 0});
  return path;
}

PrintSettings settings() {
  PrintSettings settings;
  settings.materials = {{"red", Mixture({1, 0, 0})}};
  settings.zone_materials = {0};
  settings.extent = {{20, 20}, {140, 40}};
  settings.part_height = 4 * layer_height;
  settings.layer_height = layer_height;
  settings.first_layer_height = layer_height;
  settings.speed = 30;
  settings.first_layer_speed = 0.5;
  settings.fan = {100, 2};
  settings.temperatures = {{1, 200, 55}};
  return settings;
}

/// Four layers at x = 20, and three at x = 120.
std::vector<std::string> two_parts(const Printer& printer) {
  Encoder encoder(printer, settings());
  std::vector<std::string> lines;
  const auto take = [&](const Chunk& chunk) {
    std::copy_if(chunk.lines.begin(), chunk.lines.end(), std::back_inserter(lines), is_command);
  };
  take(encoder.start());
  for (std::size_t i = 0; i < 7; ++i) {
    const bool second = i >= 4;
    PlacedLayer layer;
    layer.index = i;
    layer.height = layer_height;
    layer.top = static_cast<double>(second ? i - 3 : i + 1) * layer_height;
    layer.paths = {square_at({second ? 120.0 : 20.0, 20})};
    take(encoder.layer(layer));
  }
  take(encoder.rest());
  take(encoder.finish());
  return lines;
}

struct Step {
  double x, y, z;
  bool lays;
  double feed;
};

/// The places that the lines lead to.
std::vector<Step> steps_of(const std::vector<std::string>& lines) {
  std::vector<Step> steps;
  ModalState state;
  for (const std::string& line : lines) {
    state.run(line);
    if (!line.starts_with("G1 ") && !line.starts_with("G0 ")) continue;
    if (!state.position[0] || !state.position[1] || !state.position[2]) continue;
    const bool lays = line.find('E') != std::string::npos && line.find_first_of("XY") != std::string::npos;
    steps.push_back(
        {*state.position[0], *state.position[1], *state.position[2], lays, state.feed.value_or(0)});
  }
  return steps;
}

}  // namespace

TEST_CASE("the way to the next part leads above everything that is printed, and never drags the nozzle") {
  for (const double hop : {0.0, 0.4, 3.0}) {
    Printer printer;
    printer.z_hop = hop;
    const std::vector<Step> steps = steps_of(two_parts(printer));
    const double top = 4 * layer_height;
    bool finished = false, crossed = false;
    double lowest_after = top;
    for (std::size_t i = 1; i < steps.size(); ++i) {
      const Step &from = steps[i - 1], &to = steps[i];
      finished = finished || (to.lays && to.z > 3.5 * layer_height);
      if (finished && from.x < 100 && to.x >= 100) {  // from one part to the other
        crossed = true;
        CHECK(from.z == Approx(top + std::max(hop, 1.0)));
        CHECK(to.z == from.z);
      }
      if (crossed && to.lays) lowest_after = std::min(lowest_after, to.z);
      // The height is never changed while the nozzle moves sideways.
      if (from.z != to.z) CHECK((from.x == to.x && from.y == to.y));
    }
    CHECK(crossed);
    CHECK(lowest_after == Approx(layer_height));
    CHECK(steps.back().z >= top + 9.9);  // the end rises above the highest part
  }
}

TEST_CASE(
    "the next part begins like the first: slowly, without the fan, and at the first layer's temperatures") {
  Printer printer;
  printer.nozzle_temperature = 215;
  printer.bed_temperature = 65;
  const std::vector<std::string> lines = two_parts(printer);
  const auto count = [&](const char* line) { return std::count(lines.begin(), lines.end(), line); };
  CHECK(count("M106 S255") == 2);  // at the third layer of each
  CHECK(count("M104 S200") == 2);  // at the second layer of each
  CHECK(count("M109 S215") == 2);  // before each
  CHECK(count("M190 S65") == 2);
  CHECK(count("M107") == 2);  // before the second, and at the end
  // The filament is drawn back before the wait, so that the nozzle does not drip on the first part.
  const auto wait = std::find(lines.rbegin(), lines.rend(), "M109 S215");
  const auto pushed =
      std::find_if(wait, lines.rend(), [](const std::string& line) { return line.starts_with("G1 E"); });
  REQUIRE(pushed != lines.rend());
  CHECK(pushed->starts_with("G1 E-"));
  std::vector<double> first_feeds, second_feeds;
  for (const Step& step : steps_of(lines)) {
    if (!step.lays || step.x < 110) continue;
    (step.z < 1.5 * layer_height ? first_feeds : second_feeds).push_back(step.feed);
  }
  REQUIRE_FALSE(first_feeds.empty());
  REQUIRE_FALSE(second_feeds.empty());
  CHECK(first_feeds.back() == Approx(15 * 60).epsilon(0.01));
  CHECK(second_feeds.back() == Approx(30 * 60).epsilon(0.01));
}

TEST_CASE("a pause beside a finished part leads above that part") {
  const Printer printer;
  ModalState state;
  for (const std::string& line : two_parts(printer)) {
    state.run(line);
    if (state.position[2] && *state.position[2] < 1.5 * layer_height && state.position[0] > 110 &&
        line.find('E') != std::string::npos && line.find('Y') != std::string::npos)
      break;
  }
  REQUIRE(state.position[2] == Approx(layer_height));
  CHECK(state.laid_top == Approx(4 * layer_height));
  const Chunk aside = go_aside(printer, {state, {{20, 20}, {140, 40}}, 2, false});
  const auto rise = std::find_if(aside.lines.begin(), aside.lines.end(),
                                 [](const std::string& line) { return line.starts_with("G1 Z"); });
  REQUIRE(rise != aside.lines.end());
  CHECK(std::strtod(rise->c_str() + 4, nullptr) == Approx(4 * layer_height + 10));
}
