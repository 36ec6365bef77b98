// The lines of whole prints, played through the model of the chamber: what leaves the nozzle and where.
#include <catch2/catch.hpp>
#include <cmath>
#include <deque>
#include <map>
#include <numbers>
#include <sstream>

#include "firmware_gcode/mixing/chamber.hpp"
#include "firmware_gcode/toolpath/encoder.hpp"

using namespace unicursal;
using namespace unicursal::gcode;

namespace {

constexpr double filament_area = std::numbers::pi / 4 * 1.75 * 1.75;

/// A wavy ring around (100, 100): zone 0 above, zone 1 below.
core::BeadPath ring(std::size_t count, double radius = 30) {
  core::BeadPath path;
  for (std::size_t i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(count);
    const double r = radius + std::sin(7 * angle);
    path.beads.push_back({core::Vec2(100, 100) + r * core::Vec2(std::cos(angle), std::sin(angle)), 0.0,
                          2 * i < count ? 0u : 1u});
  }
  for (std::size_t i = 0; i < count; ++i) path.beads[i].area = 0.8 * path.length(i);
  return path;
}

PrintSettings settings_for(std::vector<Material> materials) {
  PrintSettings settings;
  settings.materials = std::move(materials);
  settings.zone_materials = {0, 1};
  settings.extent = {{60, 60}, {140, 140}};
  settings.part_height = 10;
  return settings;
}

std::vector<std::string> lines_of(Encoder& encoder, std::size_t layers) {
  std::vector<std::string> lines = encoder.start().lines;
  const auto append = [&lines](const Chunk& chunk) {
    lines.insert(lines.end(), chunk.lines.begin(), chunk.lines.end());
  };
  for (std::size_t i = 0; i < layers; ++i) {
    const double top = 0.2 * static_cast<double>(i + 1);
    append(encoder.layer({i, top, 0.2, {ring(400 + 3 * i)}}));
  }
  append(encoder.rest());
  return lines;
}

/// Calls `seen` for every bit of plastic on the part: place, shares, volume.
template <typename Seen>
void play(const std::vector<std::string>& lines, const ChamberModel& chamber, Seen seen) {
  std::map<int, Shares> tools;
  Shares collector = Shares::zeros(3), mixture{1.0 / 3, 1.0 / 3, 1.0 / 3};
  std::deque<std::pair<double, Shares>> pipe{{chamber.dead_volume, mixture}};
  Tanks tanks(chamber, mixture);
  core::Vec2 at(0, 0);
  bool part = false;
  for (const std::string& line : lines) {
    if (line == ";TYPE:Solid infill") part = true;
    std::istringstream stream(line);
    std::string command, word;
    stream >> command;
    std::map<char, double> values;
    while (stream >> word && word[0] != ';') values[word[0]] = std::atof(word.c_str() + 1);
    if (command == "M163") collector[static_cast<std::size_t>(values['S'])] = values['P'];
    if (command == "M164") tools[static_cast<int>(values['S'])] = Mixture(collector).shares();
    if (command[0] == 'T') mixture = tools.at(std::stoi(command.substr(1)));
    if (command != "G1" && command != "G0") continue;
    const core::Vec2 to(values.contains('X') ? values['X'] : at.x(),
                        values.contains('Y') ? values['Y'] : at.y());
    const double volume = (to - at).norm() > 0 && values.contains('E') ? values['E'] * filament_area : 0;
    if (volume > 0) {
      pipe.push_back({volume, mixture});
      for (double left = volume; left > 1e-12;) {
        const double piece = std::min({left, pipe.front().first, 0.05});
        const Shares out = tanks.pass(pipe.front().second, piece);
        left -= piece;
        if ((pipe.front().first -= piece) < 1e-12) pipe.pop_front();
        if (part) seen(core::Vec2(at + (to - at) * (1 - left / volume)), out, piece);
      }
    }
    at = to;
  }
}

}  // namespace

TEST_CASE("every zone gets its mixture, also across layers") {
  const PrintSettings settings =
      settings_for({{"sky", Mixture({0.7, 0.3, 0})}, {"rose", Mixture({0, 0.2, 0.8})}});
  for (const std::size_t tanks : {1u, 3u}) {
    Printer printer;
    printer.tanks = tanks;
    const ChamberModel chamber{printer.dead_volume, printer.mixing_volume, tanks};
    const auto wrong = [&](bool look_ahead) {
      PrintSettings with = settings;
      with.look_ahead = look_ahead;
      Encoder encoder(printer, with);
      const auto lines = lines_of(encoder, 6);
      double misplaced_volume = 0, nearer_to_other = 0, all = 0;
      play(lines, chamber, [&](const core::Vec2& place, const Shares& is, double volume) {
        const std::size_t zone = place.y() >= 100 ? 0 : 1;
        const double error = misplaced(is, encoder.intended(zone).shares());
        misplaced_volume += error * volume;
        if (error > misplaced(is, encoder.intended(1 - zone).shares())) nearer_to_other += volume;
        all += volume;
      });
      CHECK(all > 6 * 25);
      return std::pair(nearer_to_other, misplaced_volume);
    };
    const auto ahead = wrong(true), late = wrong(false);
    INFO(tanks << " tanks: wrong " << ahead.first << " against " << late.first << " mm³");
    CHECK(ahead.first < 0.05 * late.first);
    CHECK(ahead.second < 0.5 * late.second);
    CHECK(late.first > 6 * 3);
  }
}

TEST_CASE("a gradient's shades lie where they belong, with more mixtures than the firmware has tools") {
  PrintSettings settings =
      settings_for({{"fade", Mixture({1, 0, 0}), Gradient{Mixture({0, 1, 0}), {1, 0, 0}, 70, 130}}});
  settings.zone_materials = {0, 0};
  Printer printer;
  Encoder encoder(printer, settings);
  const auto lines = lines_of(encoder, 4);
  double error = 0, all = 0;
  play(lines, {printer.dead_volume, printer.mixing_volume, printer.tanks},
       [&](const core::Vec2& place, const Shares& is, double volume) {
         const double part = settings.materials[0].gradient->part_at(place, 0);
         error += volume * misplaced(is, encoder.intended(0, part).shares());
         all += volume;
       });
  CHECK(error < 0.02 * all);
  CHECK(std::count_if(lines.begin(), lines.end(), [](const auto& l) { return l.starts_with("M164"); }) > 60);
}

TEST_CASE("a chunk says from which line on which mixture is fed") {
  const PrintSettings settings =
      settings_for({{"sky", Mixture({0.7, 0.3, 0})}, {"rose", Mixture({0, 0.2, 0.8})}});
  for (const std::string firmware : {"marlin", "repetier"}) {
    Printer printer;
    printer.firmware = firmware;
    printer.flow_factors = {1, 1.05, 1};
    Encoder encoder(printer, settings);
    // The name of the mixture by the shares that the firmware has received, which are those of the feeders'
    // steps.
    const auto fed = [&](const Shares& received) -> std::string {
      Shares shares = received;
      for (std::size_t f = 0; f < shares.size(); ++f) shares[f] /= printer.flow_factors[f];
      const Mixture mixture(shares);
      for (std::size_t i = 0; i < 2; ++i) {
        if (misplaced(mixture.shares(), encoder.intended(i).shares()) < 1e-9)
          return settings.materials[i].name;
      }
      return shares_text(mixture);
    };
    std::map<int, Shares> tools;
    Shares collector = Shares::zeros(3);
    std::string expected, name;
    std::map<std::string, int> seen;
    const auto check = [&](Chunk chunk) {
      keep_commands(chunk);
      std::size_t next = 0;
      for (std::size_t i = 0; i < chunk.lines.size(); ++i) {
        std::istringstream stream(chunk.lines[i]);
        std::string command, word;
        stream >> command;
        std::map<char, double> values;
        while (stream >> word) values[word[0]] = std::atof(word.c_str() + 1);
        if (command == "M163") collector[static_cast<std::size_t>(values['S'])] = values['P'];
        if (command == "M164") tools[static_cast<int>(values['S'])] = collector;
        if (command[0] == 'T') expected = fed(tools.at(std::stoi(command.substr(1))));
        for (; next < chunk.mixtures.size() && chunk.mixtures[next].line == i; ++next)
          name = chunk.mixtures[next].name;
        ++seen[name];
        REQUIRE(name == expected);
      }
      CHECK(next == chunk.mixtures.size());
    };
    check(encoder.start());
    for (std::size_t i = 0; i < 3; ++i)
      check(encoder.layer({i, 0.2 * static_cast<double>(i + 1), 0.2, {ring(300)}}));
    check(encoder.rest());
    CHECK(seen["sky"] > 100);
    CHECK(seen["rose"] > 100);
    CHECK(std::any_of(seen.begin(), seen.end(), [](const auto& entry) {
      return entry.first.starts_with("0.3");  // equal shares: filament is pushed forward
    }));
    check(encoder.finish());
  }
}

TEST_CASE("every layer's share of the chunks adds up, and each ends once") {
  Encoder encoder({}, settings_for({{"sky", Mixture({0.7, 0.3, 0})}, {"rose", Mixture({0, 0.2, 0.8})}}));
  encoder.start();
  std::map<std::size_t, double> volumes;
  std::map<std::size_t, int> ends, forecasts;
  double all = 0;
  const auto take = [&](const Chunk& chunk) {
    all += chunk.volume;
    double sum = 0;
    for (const LayerShare& share : chunk.layers) {
      CHECK(ends[share.layer] == 0);
      volumes[share.layer] += share.volume;
      ends[share.layer] += share.last ? 1 : 0;
      sum += share.volume;
    }
    for (const LayerMixing& mixing : chunk.mixing) ++forecasts[mixing.layer];
    CHECK(sum == Approx(chunk.volume));
  };
  constexpr std::size_t count = 9;
  // Withheld: up to four layers for the route, and the content of the chamber.
  const std::size_t decided[count] = {1, 1, 2, 3, 3, 4, 5, 5, 6};
  for (std::size_t i = 0; i < count; ++i) {
    take(encoder.layer({i, 0.2 * static_cast<double>(i + 1), 0.2, {ring(300)}}));
    CHECK(ends.size() == decided[i]);
  }
  take(encoder.rest());
  const double layer_volume = ring(300).total_area() * 0.2;
  for (std::size_t i = 0; i < count; ++i) {
    CHECK(ends[i] == 1);
    CHECK(forecasts[i] == 1);
    if (i > 0) CHECK(volumes[i] == Approx(layer_volume));
  }
  CHECK(all > count * layer_volume);
}
