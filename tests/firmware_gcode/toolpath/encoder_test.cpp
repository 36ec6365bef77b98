#include "firmware_gcode/toolpath/encoder.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <set>
#include <sstream>

#include "core/error.hpp"

using namespace unicursal;
using namespace unicursal::gcode;

namespace {

constexpr double filament_area = std::numbers::pi / 4 * 1.75 * 1.75;

/// One line as a firmware reads it: the command and its letters.
struct Words {
  std::string command;
  std::map<char, double> values;

  explicit Words(const std::string& line) {
    std::istringstream stream(line);
    stream >> command;
    for (std::string word; stream >> word;) values[word[0]] = std::stod(word.substr(1));
  }
  bool has(char letter) const { return values.contains(letter); }
  double at(char letter) const { return values.at(letter); }
};

std::vector<std::string> commands(const Chunk& chunk) {
  std::vector<std::string> lines = chunk.lines;
  keep_commands(lines);
  return lines;
}

std::size_t index_of(const std::vector<std::string>& lines, const std::string& start) {
  const auto found =
      std::find_if(lines.begin(), lines.end(), [&](const auto& line) { return line.starts_with(start); });
  INFO("looking for " << start);
  REQUIRE(found != lines.end());
  return static_cast<std::size_t>(found - lines.begin());
}

/// A printer without overshoots.
Printer straight() {
  Printer printer;
  printer.overshoot = false;
  return printer;
}

PrintSettings two_colours() {
  PrintSettings settings;
  settings.materials = {{"sky", Mixture({0.7, 0.3, 0})}, {"rose", Mixture({0, 0.2, 0.8})}};
  settings.zone_materials = {0, 1};
  settings.extent = {{60, 60}, {140, 140}};
  settings.part_height = 10;
  return settings;
}

/// A wavy closed curve around (100, 100), its second half in zone 1.
core::BeadPath wavy_path(std::size_t count, double radius = 30) {
  core::BeadPath path;
  for (std::size_t i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(count);
    const double r = radius + std::sin(7 * angle);
    path.beads.push_back({core::Vec2(100, 100) + r * core::Vec2(std::cos(angle), std::sin(angle)), 0.0,
                          2 * i < count ? 0u : 1u});
  }
  for (std::size_t i = 0; i < count; ++i) {
    path.beads[i].area = path.length(i) * (0.8 + 0.2 * std::sin(static_cast<double>(i)));
  }
  return path;
}

PlacedLayer layer_of(std::vector<core::BeadPath> paths, std::size_t index = 0) {
  return {index, 0.2 * static_cast<double>(index + 1), 0.2, std::move(paths)};
}

/// The feed of a chunk, read back from its text.
struct Played {
  double bead_filament = 0;       ///< mm, with motion in the plane
  double still_filament = 0;      ///< mm, without
  std::map<int, double> by_tool;  ///< mm, of bead_filament
  double travel = 0;              ///< mm
  core::Vec2 position{0, 0};
  int tool = -1;
  double z = 0, feed = 0;
  double most_filament = 0;                      ///< mm, of one line
  std::vector<std::pair<double, double>> flows;  ///< mm of filament per s, mm long
};

void play(const Chunk& chunk, Played& state) {
  for (const std::string& line : commands(chunk)) {
    if (line.starts_with('T')) state.tool = std::stoi(line.substr(1));
    if (!line.starts_with("G0") && !line.starts_with("G1")) continue;
    const Words words(line);
    const core::Vec2 to(words.has('X') ? words.at('X') : state.position.x(),
                        words.has('Y') ? words.at('Y') : state.position.y());
    const double length = (to - state.position).norm();
    const double e = words.has('E') ? words.at('E') : 0;
    if (words.has('F')) state.feed = words.at('F') / 60;
    if (words.has('Z')) state.z = words.at('Z');
    if (length > 0 && words.has('E')) {
      state.bead_filament += e, state.by_tool[state.tool] += e;
      state.flows.push_back({e / length * state.feed, length});
    } else if (length > 0) {
      state.travel += length;
    } else {
      state.still_filament += e;
    }
    state.most_filament = std::max(state.most_filament, e);
    state.position = to;
  }
}

/// The chunks of all layers as one chunk.
Chunk printed(Encoder& encoder, const std::vector<PlacedLayer>& layers) {
  Chunk all;
  const auto add_chunk = [&all](const Chunk& chunk) {
    all.lines.insert(all.lines.end(), chunk.lines.begin(), chunk.lines.end());
    all.warnings.insert(all.warnings.end(), chunk.warnings.begin(), chunk.warnings.end());
    all.layers.insert(all.layers.end(), chunk.layers.begin(), chunk.layers.end());
    for (const auto& [mixture, volume] : chunk.mixture_volumes) add(all.mixture_volumes, mixture, volume);
    all.volume += chunk.volume;
    all.prime_volume += chunk.prime_volume;
  };
  for (const PlacedLayer& layer : layers) add_chunk(encoder.layer(layer));
  add_chunk(encoder.rest());
  return all;
}

/// The lines of one layer.
Chunk only_layer(const Chunk& all, std::size_t index) {
  Chunk one;
  std::size_t changes = 0;
  for (const std::string& line : all.lines) {
    if (line == ";LAYER_CHANGE") ++changes;
    if (changes == index + 1) one.lines.push_back(line);
  }
  return one;
}

/// Settings with that many mixtures, all different.
PrintSettings many_colours(std::size_t count) {
  PrintSettings settings = two_colours();
  while (settings.materials.size() < count) {
    settings.materials.push_back(
        {"more", Mixture({1, 0.05 * static_cast<double>(settings.materials.size()), 0})});
  }
  return settings;
}

}  // namespace

TEST_CASE("the start: shutdown timer first, heat, home, modes, tools") {
  Encoder encoder({}, two_colours());
  const auto lines = commands(encoder.start());
  CHECK(lines.front() == "M85 S1800");
  CHECK(index_of(lines, "M140 S60") < index_of(lines, "G28"));
  CHECK(index_of(lines, "M104 S210") < index_of(lines, "G28"));
  CHECK(index_of(lines, "G28") < index_of(lines, "M190 S60"));
  CHECK(index_of(lines, "G28") < index_of(lines, "M109 S210"));
  CHECK(index_of(lines, "G90") < index_of(lines, "M83"));  // G90 overrides M83
  index_of(lines, "M220 S100");
  index_of(lines, "M221 S100");
  index_of(lines, "G21");
  index_of(lines, "G92 E0");
}

TEST_CASE("every tool is defined by all three feeders before it is used") {
  const bool overshoot = GENERATE(false, true);
  Encoder encoder(overshoot ? Printer() : straight(), two_colours());
  auto lines = commands(encoder.start());
  for (const Chunk& chunk : {printed(encoder, {layer_of({wavy_path(100)})}), encoder.finish()}) {
    for (const auto& line : commands(chunk)) lines.push_back(line);
  }
  std::map<int, double> shares;
  std::map<int, bool> defined;
  for (const auto& line : lines) {
    const Words words(line);
    if (words.command == "M163") shares[static_cast<int>(words.at('S'))] = words.at('P');
    if (words.command == "M164") {
      REQUIRE(shares.size() == 3);
      double sum = 0;
      for (const auto& [feeder, share] : shares) {
        CHECK(share >= 0.0199);
        sum += share;
      }
      CHECK(sum == Approx(1).margin(2e-4));
      shares.clear();
      defined[static_cast<int>(words.at('S'))] = true;
    }
    if (line.starts_with('T')) CHECK(defined[std::stoi(line.substr(1))]);
  }
  if (overshoot)
    CHECK(defined.size() > 3);  // and those of overshoots
  else
    CHECK(defined.size() == 3);  // two materials and the retraction tool
}

TEST_CASE("intended mixtures have the floor share and the resolution of the lines") {
  Encoder encoder({}, two_colours());
  const Mixture sky = encoder.intended(0);
  CHECK(sky.share(0) == Approx(0.686));  // 0.7 and 0.3 of the rest above the floor of 0.02
  CHECK(sky.share(1) == Approx(0.294));
  CHECK(sky.share(2) == Approx(0.02));
  const auto lines = commands(encoder.start());
  const auto first = index_of(lines, "M163 S0");
  CHECK(lines[first] == "M163 S0 P.686");
  CHECK(lines[first + 1] == "M163 S1 P.294");
  CHECK(lines[first + 2] == "M163 S2 P.02");
  CHECK(lines[first + 3] == "M164 S0");
}

TEST_CASE(
    "sixteen mixtures leave no retraction tool, with seventeen there is one and the others are redefined") {
  Encoder sixteen({}, many_colours(16));
  auto lines = commands(sixteen.start());
  CHECK(std::count(lines.begin(), lines.end(), "M164 S15") == 1);
  CHECK(std::none_of(lines.begin(), lines.end(), [](const auto& l) { return l == "M164 S16"; }));

  PrintSettings settings = many_colours(17);
  settings.zone_materials.clear();
  for (std::size_t i = 0; i < 17; ++i) settings.zone_materials.push_back(i);
  Encoder seventeen({}, settings);
  lines = commands(seventeen.start());
  core::BeadPath path = wavy_path(170, 60);
  for (std::size_t i = 0; i < path.size(); ++i) path.beads[i].zone = i / 10;
  for (const auto& line : commands(printed(seventeen, {layer_of({path}), layer_of({path}, 1)}))) {
    lines.push_back(line);
  }
  std::map<int, std::string> collector, tools;
  std::set<std::string> used;
  int tool = -1;
  for (const auto& line : lines) {
    const Words words(line);
    if (words.command == "M163") collector[static_cast<int>(words.at('S'))] = line;
    if (words.command == "M164") {
      CHECK(words.at('S') != tool);  // never the one in use
      tools[static_cast<int>(words.at('S'))] = collector[0] + collector[1] + collector[2];
    }
    if (line.front() == 'T') tool = std::stoi(line.substr(1));
    if (line.front() == 'G' && words.has('E') && words.has('X')) used.insert(tools.at(tool));
  }
  CHECK(used.size() == 17);
  CHECK(tools.size() == 16);
}

TEST_CASE("extruded filament is area times height, for each mixture") {
  Encoder encoder(straight(), two_colours());
  encoder.start();
  Played played;
  double volume = 0, prime = 0;
  std::vector<PlacedLayer> layers;
  for (std::size_t index = 0; index < 20; ++index) {
    const auto path = wavy_path(997 + index);
    volume += path.total_area() * 0.2;
    layers.push_back(layer_of({path}, index));
  }
  const Chunk chunk = printed(encoder, layers);
  play(chunk, played);
  prime = chunk.prime_volume;
  CHECK(chunk.volume == Approx(prime + volume).epsilon(1e-12));
  CHECK(played.bead_filament == Approx(chunk.volume / filament_area).margin(2e-5));
  double by_layer = 0;
  for (const LayerShare& share : chunk.layers) by_layer += share.volume;
  CHECK(by_layer == Approx(chunk.volume));
  // Each mixture's volume is that of the lines: where the tool changes, one rounding unit may be
  // lost.
  REQUIRE(chunk.mixture_volumes.size() == 2);
  for (const auto& [mixture, fed] : chunk.mixture_volumes) {
    const int tool = mixture == encoder.intended(0) ? 0 : 1;
    CHECK(mixture == encoder.intended(static_cast<std::size_t>(tool)));
    CHECK(played.by_tool[tool] == Approx(fed / filament_area).margin(20 * 2e-5));
  }
  CHECK(prime > 2 * 6.1 * 0.99);
}

TEST_CASE("flow is constant to one per cent where the axes allow it") {
  PrintSettings settings = two_colours();
  settings.flow = 1.5;
  Encoder encoder({}, settings);
  encoder.start();
  Played played;
  play(printed(encoder, {layer_of({wavy_path(500)})}), played);
  REQUIRE(played.flows.size() > 480);
  for (const auto& [flow, length] : played.flows) {
    // 0.001 mm of position in beads of 0.4 mm adds to the tolerance of the feed rate
    CHECK(flow * filament_area == Approx(1.5).epsilon(0.02));
  }
}

TEST_CASE("speed never exceeds what an axis can do") {
  Printer printer;
  printer.max_speed = {10, 20, 5};
  PrintSettings settings = two_colours();
  settings.flow = 8;  // would be 50 mm/s
  Encoder encoder(printer, settings);
  encoder.start();
  const Chunk chunk = printed(encoder, {layer_of({wavy_path(200)})});
  core::Vec2 at(0, 0);
  double feed = 0;
  for (const auto& line : commands(chunk)) {
    const Words words(line);
    if (words.command != "G0" && words.command != "G1") continue;
    if (words.has('F')) feed = words.at('F') / 60;
    const core::Vec2 to(words.has('X') ? words.at('X') : at.x(), words.has('Y') ? words.at('Y') : at.y());
    if (to != at && words.has('E')) {
      const core::Vec2 velocity = (to - at).normalized() * feed;
      CHECK(std::abs(velocity.x()) <= 10 * 1.015);
      CHECK(std::abs(velocity.y()) <= 20 * 1.015);
    }
    at = to;
  }
}

TEST_CASE("a layer is a closed loop, and the next one starts where it ends") {
  for (const Seam seam : {Seam::hidden, Seam::scattered, Seam::aligned, Seam::nearest}) {
    PrintSettings settings = two_colours();
    settings.seam = seam;
    Encoder encoder({}, settings);
    encoder.start();
    std::vector<PlacedLayer> layers;
    for (std::size_t i = 0; i < 10; ++i) layers.push_back(layer_of({wavy_path(300 + 7 * i)}, i));
    const Chunk all = printed(encoder, layers);
    Played played;
    play(only_layer(all, 0), played);
    const double still = played.still_filament;
    for (std::size_t i = 1; i < layers.size(); ++i) {
      const core::Vec2 begin = played.position;
      played.travel = 0;
      play(only_layer(all, i), played);
      CHECK(played.travel < 1.5);             // not a travel, but the step to the next layer's nearest vertex
      CHECK(played.still_filament == still);  // no retraction
      CHECK((played.position - begin).norm() < 1.5);
      CHECK(played.z == Approx(layers[i].top));
    }
  }
}

TEST_CASE("a travel retracts all inlets alike and undoes that") {
  auto far = wavy_path(50, 4);
  for (auto& bead : far.beads) bead.position += core::Vec2(60, 0);
  Encoder encoder(straight(), two_colours());
  encoder.start();
  const Chunk all = printed(encoder, {layer_of({wavy_path(300)}, 0), layer_of({wavy_path(300), far}, 1)});
  const auto lines = commands(only_layer(all, 1));
  const auto back = index_of(lines, "G1 E-4");
  CHECK(lines[back - 1] == "T2");
  CHECK(lines[back + 1].starts_with("G0 X"));
  CHECK(lines[back + 2].starts_with("G1 E4"));
  CHECK(lines[back + 3].starts_with("T"));
  CHECK(lines[back + 3] != "T2");
}

TEST_CASE("the prime line keeps clear of the part or is omitted") {
  const auto primed = [](const core::Box& extent) {
    PrintSettings settings = two_colours();
    settings.extent = extent;
    Encoder encoder({}, settings);
    encoder.start();
    return printed(encoder, {layer_of({wavy_path(100)})});
  };
  const Chunk front = primed({{60, 60}, {140, 140}});
  CHECK(index_of(commands(front), "G0 X5 Y5") < index_of(commands(front), "G1 E4"));
  CHECK(front.prime_volume > 12);
  // The part covers the front edge: the left edge is next.
  const Chunk left = primed({{60, 0}, {140, 140}});
  CHECK(index_of(commands(left), "G0 X5 Y5") < index_of(commands(left), "G1 Y"));
  CHECK(index_of(commands(left), "G1 Y") < index_of(commands(left), "G1 E-4"));
  const Chunk none = primed({{0, 0}, {200, 200}});
  CHECK(none.prime_volume == 0);
  index_of(none.lines, "; no prime line");
  REQUIRE(none.warnings.size() == 1);
  CHECK(none.warnings[0].find("no prime line") == 0);
  CHECK(front.warnings.empty());
}

TEST_CASE("the nozzle is primed with the first mixture of the part") {
  Encoder encoder(straight(), two_colours());
  encoder.start();
  const auto lines = commands(printed(encoder, {layer_of({wavy_path(300)})}));
  std::vector<std::string> tools;
  std::copy_if(lines.begin(), lines.end(), std::back_inserter(tools),
               [](const auto& line) { return line.starts_with('T'); });
  REQUIRE(tools.size() >= 4);  // push forward, prime, draw back and push forward, first bead
  CHECK(tools[0] == "T2");
  CHECK(tools[1] == tools[3]);
}

TEST_CASE("long beads are split below the firmware's limit") {
  core::BeadPath path;
  path.beads = {{{50, 50}, 5000.0, 0}, {{150, 50}, 1.0, 0}, {{150, 51}, 1.0, 0}};
  PrintSettings settings = two_colours();
  Encoder encoder({}, settings);
  encoder.start();
  Played played;
  const Chunk chunk = printed(encoder, {{0, 0.3, 0.3, {path}}});
  play(chunk, played);
  CHECK(played.most_filament < 200);
  CHECK(played.bead_filament == Approx(chunk.volume / filament_area).margin(2e-5));
}

TEST_CASE("no line is longer than a firmware keeps, even numbered") {
  Printer printer;
  printer.start_gcode = "M117 " + std::string(75, 'x') + "\n; only a comment\n\n  G29 ; probe\n";
  Encoder encoder(printer, two_colours());
  std::vector<Chunk> chunks = {encoder.start()};
  for (std::size_t i = 0; i < 5; ++i) chunks.push_back(encoder.layer(layer_of({wavy_path(1000)}, i)));
  chunks.push_back(encoder.rest());
  chunks.push_back(encoder.finish());
  for (const Chunk& chunk : chunks) {
    for (const auto& line : commands(chunk)) CHECK(line.size() + std::string("N99999999 *255").size() <= 95);
  }
  const auto start = commands(chunks.front());
  CHECK(start[index_of(start, "M117") + 1] == "G29");
  CHECK(index_of(start, "M109") < index_of(start, "G29"));
  CHECK(index_of(start, "G29") < index_of(start, "G90"));
}

TEST_CASE("the end leaves the printer cold and away from the part") {
  Printer printer;
  printer.end_gcode = "M300";
  Encoder encoder(printer, two_colours());
  encoder.start();
  printed(encoder, {layer_of({wavy_path(100)}, 0)});
  const auto lines = commands(encoder.finish());
  CHECK(index_of(lines, "G1 E-4") < index_of(lines, "G1 Z20"));  // part height 10 and 10 above
  CHECK(index_of(lines, "G1 Z20") < index_of(lines, "G0 X0 Y200"));
  index_of(lines, "M140 S0");
  index_of(lines, "M107");
  CHECK(index_of(lines, "M104 S0") < index_of(lines, "M300"));
  CHECK(index_of(lines, "M84") + 2 == lines.size());
  CHECK(lines.back() == "M85 S0");  // else the firmware halts half an hour after the print
}

TEST_CASE("the user's own lines can neither heat after the end nor outlive the inactivity shutdown") {
  Printer printer;
  printer.start_gcode = "M85 S0\nG91";
  printer.end_gcode = "M104 S220\nM140 S90\nM106 S255";
  Encoder encoder(printer, two_colours());
  const auto start = commands(encoder.start());
  const auto last_of = [](const std::vector<std::string>& lines, const std::string& command) {
    const auto found =
        std::find_if(lines.rbegin(), lines.rend(), [&](const auto& l) { return l.starts_with(command); });
    REQUIRE(found != lines.rend());
    return *found;
  };
  CHECK(last_of(start, "M85") == "M85 S1800");
  CHECK(last_of(start, "G9") == "G92 E0");
  CHECK(index_of(start, "G91") < index_of(start, "G90"));
  const auto end = commands(encoder.finish());
  CHECK(last_of(end, "M104") == "M104 S0");
  CHECK(last_of(end, "M140") == "M140 S0");
  CHECK(last_of(end, "M10") == "M107");
  CHECK(index_of(end, "M104 S0") < index_of(end, "M104 S220"));  // off while they run, too
  CHECK(end.back() == "M85 S0");
}

TEST_CASE("the end is correct wherever the printer has stopped") {
  const PrintSettings all_tools = many_colours(16);
  for (const PrintSettings& settings : {two_colours(), all_tools}) {
    Encoder encoder(straight(), settings);
    encoder.start();
    // The print may end at x = 0, where the end parks: x must still be written.
    core::BeadPath triangle;
    triangle.beads = {{{0, 150}, 20.0, 0}, {{0, 200}, 0.5, 0}, {{1, 200}, 20.0, 0}};
    Played played;
    play(printed(encoder, {layer_of({triangle})}), played);
    REQUIRE(played.position.x() <= 1);
    const auto lines = commands(encoder.finish());
    const auto back = index_of(lines, "G1 E-4");
    CHECK(index_of(lines, "G90") < index_of(lines, "M83"));
    CHECK(index_of(lines, "M83") < back);
    CHECK(index_of(lines, settings.materials.size() == 16 ? "T0" : "T2") < back);
    CHECK(lines[back] == "G1 E-4 F1500");
    CHECK(lines[back + 1] == "G1 Z20 F600");
    CHECK(lines[back + 2] == "G0 X0 Y200 F9000");
  }
}

TEST_CASE("with every virtual tool taken, one tool draws back and pushes forward") {
  const PrintSettings settings = many_colours(16);
  auto far = wavy_path(50, 4);
  for (auto& bead : far.beads) bead.position += core::Vec2(60, 0), bead.zone = 1;
  Encoder encoder({}, settings);
  encoder.start();
  const auto lines =
      commands(only_layer(printed(encoder, {layer_of({wavy_path(300)}, 0), layer_of({far}, 1)}), 1));
  const auto back = index_of(lines, "G1 E-4");
  const auto forward = index_of(lines, "G1 E4");
  CHECK(std::none_of(lines.begin() + static_cast<std::ptrdiff_t>(back),
                     lines.begin() + static_cast<std::ptrdiff_t>(forward),
                     [](const auto& line) { return line.starts_with('T'); }));
}

TEST_CASE("a part that would begin in the air is refused") {
  Encoder encoder({}, two_colours());
  encoder.start();
  encoder.layer(layer_of({}, 0));
  CHECK_THROWS_WITH(encoder.layer(layer_of({wavy_path(100)}, 1)),
                    Catch::Contains("layer 1") && Catch::Contains("in the air at 0.2 mm") &&
                        Catch::Contains("turn or place the part"));
  // A refusal has no effect, and the nozzle is primed once.
  const Chunk all = printed(encoder, {layer_of({wavy_path(100)}, 0), layer_of({wavy_path(100)}, 2)});
  CHECK(std::count(all.lines.begin(), all.lines.end(), ";TYPE:Custom") == 1);
  CHECK(all.layers.size() >= 2);
}

TEST_CASE("an end without a beginning moves nothing") {
  Encoder encoder({}, two_colours());
  encoder.start();
  for (const auto& line : commands(encoder.finish())) CHECK(line.front() != 'G');
}

TEST_CASE("names cannot inject commands into a file") {
  PrintSettings settings = two_colours();
  settings.materials[0].name = "sky\nM104 S300";
  Encoder encoder({}, settings);
  for (const auto& line : encoder.start().lines) CHECK(line.find('\n') == std::string::npos);
}

TEST_CASE("impossible layers are refused with layer and place, and change nothing") {
  Encoder encoder({}, two_colours()), undisturbed({}, two_colours());
  encoder.start(), undisturbed.start();
  auto outside = wavy_path(100);
  outside.beads[50].position.x() = -0.5;
  CHECK_THROWS_WITH(encoder.layer(layer_of({outside}, 7)), Catch::Contains("layer 7") &&
                                                               Catch::Contains("x -0.500") &&
                                                               Catch::Contains("leave the bed"));
  auto broken = wavy_path(100);
  broken.beads[3].position.y() = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS(encoder.layer(layer_of({broken})), core::DataError);
  broken = wavy_path(100);
  broken.beads[3].area = std::numeric_limits<double>::infinity();
  CHECK_THROWS_AS(encoder.layer(layer_of({broken})), core::DataError);
  broken.beads[3].area = 1e30;  // finite, but would be split into endless moves
  CHECK_THROWS_AS(encoder.layer(layer_of({broken})), core::DataError);
  broken.beads[3].area = -1;
  CHECK_THROWS_AS(encoder.layer(layer_of({broken})), core::DataError);
  broken = wavy_path(100);
  broken.beads[3].zone = 2;
  CHECK_THROWS_WITH(encoder.layer(layer_of({broken})), Catch::Contains("zone 2 has no mixture"));
  CHECK_THROWS_AS(encoder.layer({0, 0.2, 0, {wavy_path(10)}}), core::DataError);
  CHECK_THROWS_AS(encoder.layer({0, 200.3, 0.2, {wavy_path(10)}}), core::DataError);
  CHECK(printed(encoder, {layer_of({wavy_path(100)})}).lines ==
        printed(undisturbed, {layer_of({wavy_path(100)})}).lines);
}

TEST_CASE("impossible printers and settings are refused") {
  const auto refused = [](const Printer& printer, const PrintSettings& settings, const std::string& part) {
    CHECK_THROWS_WITH(Encoder(printer, settings), Catch::Contains(part));
  };
  PrintSettings settings = two_colours();
  settings.flow = 8.1;
  refused({}, settings, "max_flow");
  settings.flow = 0;
  refused({}, settings, "flow");
  settings = two_colours();
  settings.zone_materials = {0, 2};
  refused({}, settings, "does not exist");
  settings.materials.clear();
  refused({}, settings, "at least one mixture");
  Printer printer;
  printer.firmware = "klipper";
  refused(printer, two_colours(), "klipper");
  printer = {}, printer.floor_share = 0.4;
  refused(printer, two_colours(), "floor_share");
  printer = {}, printer.max_speed[1] = 0;
  refused(printer, two_colours(), "max_speed");
  printer = {}, printer.max_speed[2] = 1e300;
  refused(printer, two_colours(), "max_speed");
  printer = {}, printer.retraction_speed = 1e15;
  refused(printer, two_colours(), "retraction_speed");
  printer = {}, printer.bed[0] = std::numeric_limits<double>::infinity();
  refused(printer, two_colours(), "bed");
  printer = {}, printer.filament_diameter = 1e-9;
  refused(printer, two_colours(), "filament_diameter");
  printer = {}, printer.mixing_volume = std::nan("");
  refused(printer, two_colours(), "mixing_volume");
  printer = {}, printer.start_gcode = "G28\nN5 G28*12";
  refused(printer, two_colours(), "gcode.start, line 2");
  printer = {}, printer.end_gcode = std::string(81, 'M');
  refused(printer, two_colours(), "longer than 80");
}

TEST_CASE("empty layers and paths of one point are accepted") {
  Encoder encoder({}, two_colours());
  encoder.start();
  core::BeadPath point;
  point.beads = {{{100, 100}, 0.0, 0}};
  CHECK(commands(encoder.layer(layer_of({}))).empty());
  CHECK(commands(encoder.layer(layer_of({point, {}}))).empty());
  CHECK(printed(encoder, {layer_of({wavy_path(10)})}).prime_volume > 0);  // the first layer with beads
}
