#include "firmware_gcode/mixing/schedule.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "firmware_gcode/mixing/forecast.hpp"

using namespace unicursal;
using namespace unicursal::gcode;

namespace {

Palette palette_of(const std::vector<Material>& materials) {
  return Palette(materials, [](const Mixture& mixture) {
    return CalibratedMixture{mixture.with_floor(0.02), mixture.with_floor(0.02)};
  });
}

const std::vector<Material> two = {{"blue", Mixture({1, 0, 0}), {}, false},
                                   {"red", Mixture({0, 1, 0}), {}, false}};
const std::vector<Material> three = {{"orange", Mixture({1, 1, 0}), {}, false},
                                     {"green", Mixture({0, 1, 1}), {}, false},
                                     {"grey", Mixture({1, 1, 1}), {}, false}};

LayerMaterials all_of(const Palette& palette) {
  std::vector<std::size_t> materials;
  for (std::size_t i = 0; i < palette.size(); ++i) materials.push_back(i);
  return std::make_shared<const std::vector<std::size_t>>(materials);
}

/// The primed volume, mm³; afterwards the chamber is full of the first material.
constexpr double primed = 20;

struct Visit {
  std::size_t material;
  double volume;
};

std::vector<WantedBead> pieces_of(const std::vector<Visit>& visits, const Palette& palette,
                                  double bead = 0.07) {
  std::vector<WantedBead> pieces;
  const LayerMaterials layer_materials = all_of(palette);
  pieces.push_back({primed, visits.front().material, 0, 0.02, false, 0, layer_materials});
  for (const Visit& visit : visits) {
    const auto count = static_cast<std::size_t>(std::ceil(visit.volume / bead));
    for (std::size_t i = 0; i < count; ++i) {
      pieces.push_back(
          {visit.volume / static_cast<double>(count), visit.material, 0, 1, false, 0, layer_materials});
    }
  }
  return pieces;
}

std::vector<Switch> scheduled(const Palette& palette, const std::vector<WantedBead>& pieces,
                              const ScheduleOptions& options = {}) {
  Schedule schedule(palette, options);
  for (const WantedBead& piece : pieces) schedule.add(piece);
  schedule.end();
  return schedule.take();
}

LayerMixing forecast_of(const Palette& palette, const std::vector<WantedBead>& pieces,
                        const std::vector<Switch>& switches, const ChamberModel& chamber) {
  Forecast forecast(palette, chamber);
  for (const WantedBead& piece : pieces) forecast.add(piece);
  for (const Switch& s : switches) forecast.add(s);
  return forecast.rest().front();
}

double loss_of(const Palette& palette, const std::vector<WantedBead>& pieces,
               const std::vector<Switch>& switches, const ChamberModel& chamber) {
  const LayerMixing mixing = forecast_of(palette, pieces, switches, chamber);
  return mixing.misplaced + mixing.wrong;
}

}  // namespace

TEST_CASE("the response begins after the dead volume and reaches 95 % after the mixing volume") {
  for (std::size_t tanks = 1; tanks <= 6; ++tanks) {
    const ChamberModel chamber{2.1, 4.0, tanks};
    CHECK(chamber.step_response(2.1) == Approx(0).margin(1e-12));
    CHECK(chamber.step_response(6.1) == Approx(0.95));
    CHECK(chamber.step_response(chamber.delay(0.5)) == Approx(0.5));
    CHECK(chamber.delay(0) == Approx(2.1));
  }
  const ChamberModel one{0, 3, 1};  // a single tank responds exponentially
  CHECK(one.step_response(1) == Approx(1 - std::pow(0.05, 1.0 / 3)));
  CHECK(one.mean_delay() == Approx(3 / std::log(20)));
  const ChamberModel sharp{1.5, 0, 2};
  CHECK(sharp.step_response(1.4) == 0);
  CHECK(sharp.step_response(1.6) == 1);
}

TEST_CASE("tanks respond like the closed form, however the volume is divided") {
  const ChamberModel chamber{0, 4, 3};
  std::mt19937 random(5);
  std::uniform_real_distribution<double> volume(0.01, 1.2);
  Tanks tanks(chamber, {1, 0, 0});
  const Shares red{0, 1, 0};
  double passed = 0, arrived = 0;
  while (passed < 8) {
    const double piece = volume(random);
    const Shares out = tanks.pass(red, piece);
    CHECK(out[0] + out[1] == Approx(1));
    passed += piece;
    arrived += out[1] * piece;
    // The volume that has left is the integral of the response, by Simpson's rule.
    double integral = 0;
    constexpr int parts = 400;
    for (int i = 0; i <= parts; ++i) {
      const double weight = i == 0 || i == parts ? 1 : i % 2 == 1 ? 4 : 2;
      integral += weight * chamber.step_response(passed * i / parts) * passed / parts / 3;
    }
    CHECK(arrived == Approx(integral).epsilon(1e-6));
  }
}

TEST_CASE("a single change has its 50 % point on the border, or the requested fraction") {
  const Palette palette = palette_of(two);
  for (std::size_t tanks : {1u, 2u, 3u, 6u}) {
    for (double share : {0.5, 0.2, 0.8}) {
      // Fractions other than one half are rounded to the grid of steps.
      const double tolerance = share == 0.5 ? 1e-6 : 0.25;
      const ScheduleOptions options{{2.1, 4.0, tanks}, share, true};
      const auto switches = scheduled(palette, pieces_of({{0, 30}, {1, 30}, {0, 30}}, palette), options);
      INFO(tanks << " tanks, share " << share);
      REQUIRE(switches.size() == 3);
      CHECK(switches[0].at == 0);
      CHECK(switches[0].shade == Shade{0, 0});
      CHECK(switches[1].at == Approx(primed + 30 - options.chamber.delay(share)).margin(tolerance));
      CHECK(switches[1].shade == Shade{1, 0});
      CHECK(switches[2].at == Approx(primed + 60 - options.chamber.delay(share)).margin(tolerance));
    }
  }
}

TEST_CASE("a chamber that does not mix only delays") {
  const Palette palette = palette_of(two);
  const ScheduleOptions options{{3, 0, 2}, 0.5, true};
  const auto switches = scheduled(palette, pieces_of({{0, 10}, {1, 0.5}, {0, 10}}, palette), options);
  REQUIRE(switches.size() == 3);
  CHECK(switches[1].at == Approx(primed + 7));
  CHECK(switches[2].at == Approx(primed + 7.5));
}

TEST_CASE("a schedule does not depend on how the path arrives") {
  const Palette palette = palette_of(three);
  std::mt19937 random(11);
  std::uniform_real_distribution<double> volume(0.3, 9);
  std::vector<Visit> visits;
  for (std::size_t i = 0; i < 60; ++i) visits.push_back({random() % 3, volume(random)});
  const auto pieces = pieces_of(visits, palette);
  const auto at_once = scheduled(palette, pieces);
  Schedule schedule(palette, {});
  std::vector<Switch> bit_by_bit;
  double certain = 0;
  const auto take = [&] {
    for (const Switch& s : schedule.take()) {
      CHECK(s.at >= certain);  // certain switches do not change
      bit_by_bit.push_back(s);
    }
    CHECK(schedule.certain() >= certain);
    certain = schedule.certain();
  };
  double volume_in = 0;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    schedule.add(pieces[i]);
    volume_in += pieces[i].volume;
    if (random() % 5 == 0) take();
    if (i > 0)
      CHECK(volume_in - certain < 2.1 + 4 * 4.0 + pieces[0].volume);  // the withheld volume is bounded
  }
  schedule.end();
  take();
  REQUIRE(bit_by_bit.size() == at_once.size());
  for (std::size_t i = 0; i < at_once.size(); ++i) {
    CHECK(bit_by_bit[i].at == at_once[i].at);
    CHECK(bit_by_bit[i].shade == at_once[i].shade);
  }
  CHECK(certain == Approx(volume_in));
}

TEST_CASE("a short visit shows completely, one that is too short is omitted") {
  const Palette palette = palette_of(two);
  const ChamberModel chamber{2.1, 4.0, 3};
  const auto long_enough = pieces_of({{0, 30}, {1, 2.0}, {0, 30}}, palette);
  const auto switches = scheduled(palette, long_enough, {chamber, 0.5, true});
  REQUIRE(switches.size() == 3);
  CHECK(forecast_of(palette, long_enough, switches, chamber).wrong < 0.35);
  CHECK(forecast_of(palette, long_enough, switches, chamber).passed_over == 0);
  CHECK(switches[2].at - switches[1].at > 1.7);

  const auto too_short = pieces_of({{0, 30}, {1, 0.1}, {0, 30}}, palette);
  CHECK(scheduled(palette, too_short, {chamber, 0.5, true}).size() == 1);
}

TEST_CASE("no choice of switches on a grid misplaces less, for short and long visits", "[optimised]") {
  const ChamberModel chamber{1.0, 2.0, 2};
  std::mt19937 random(23);
  std::uniform_real_distribution<double> volume(0.2, 3.0);
  for (int round = 0; round < 40; ++round) {
    const Palette palette = palette_of(round % 2 == 0 ? two : three);
    const std::size_t materials = palette.size();
    std::vector<Visit> visits{{0, 6}};
    for (int i = 0; i < 2; ++i)
      visits.push_back(
          {(visits.back().material + 1 + random() % (materials - 1)) % materials, volume(random)});
    visits.push_back({(visits.back().material + 1) % materials, 6});
    const auto pieces = pieces_of(visits, palette);
    const double found = loss_of(palette, pieces, scheduled(palette, pieces, {chamber, 0.5, true}), chamber);

    // All sequences of up to three switches, in steps of a tenth of the mixing volume around the borders.
    double least = std::numeric_limits<double>::infinity();

    const double first = primed + 6 - 1.0 - 1.8,
                 last = primed + 6 + visits[1].volume + visits[2].volume - 1.0;
    constexpr double grid = 0.2;
    const auto try_switches = [&](const std::vector<Switch>& tail) {
      std::vector<Switch> all{{0, {0, 0}}};
      all.insert(all.end(), tail.begin(), tail.end());
      const double loss = loss_of(palette, pieces, all, chamber);
      least = std::min(least, loss);
    };
    const std::size_t a = visits[1].material, b = visits[2].material, c = visits[3].material;
    for (double x = first; x <= last; x += grid) {
      try_switches({{x, {c, 0}}});
      for (double y = x + grid; y <= last; y += grid) {
        try_switches({{x, {a, 0}}, {y, {c, 0}}});
        try_switches({{x, {b, 0}}, {y, {c, 0}}});
        for (double z = y + grid; z <= last; z += grid) {
          try_switches({{x, {a, 0}}, {y, {b, 0}}, {z, {c, 0}}});
        }
      }
    }
    INFO("round " << round << ": visits of " << visits[1].volume << " and " << visits[2].volume << " mm³");
    CHECK(found <= least + 0.15);
  }
}

TEST_CASE("a transition zone takes up all changes that fit") {
  const std::vector<Material> materials = {{"blue", Mixture({1, 0, 0}), {}, false},
                                           {"red", Mixture({0, 1, 0}), {}, false},
                                           {"white", Mixture({0, 0, 1}), {}, true}};
  const Palette palette = palette_of(materials);
  const ChamberModel chamber{2.1, 4.0, 3};
  for (double width : {3.0, 5.0, 7.0, 12.0}) {
    auto pieces = pieces_of({{0, 30}, {2, width}, {1, 30}, {2, width}, {1, 20}}, palette);
    for (WantedBead& piece : pieces) {
      if (piece.material == 2) piece.weight = 0.02, piece.takes_changes = true;
    }
    const auto mixing =
        forecast_of(palette, pieces, scheduled(palette, pieces, {chamber, 0.5, true}), chamber);
    INFO("a zone of " << width << " mm³");
    CHECK(mixing.crossings == 1);  // the second visit returns to its first material
    CHECK(mixing.short_crossings == (width < 4 ? 1 : 0));
    CHECK(mixing.shortest_crossing == Approx(width));
    CHECK(mixing.wrong == 0);
    CHECK(mixing.misplaced < (width < 4 ? 0.8 : 0.3));
  }
}

TEST_CASE("a gradient arrives where it is wanted, in invisible steps") {
  std::vector<Material> materials = two;
  materials.push_back({"fade", Mixture({1, 0, 0}), Gradient{Mixture({0, 1, 0}), {1, 0, 0}, 0, 100}, false});
  const Palette palette = palette_of(materials);
  CHECK(palette.steps_of(2) == Palette::steps + 1);
  const ChamberModel chamber{2.1, 4.0, 3};
  std::vector<WantedBead> pieces = pieces_of({{0, 20}}, palette);
  for (int i = 0; i < 1000; ++i)
    pieces.push_back({0.1, 2, (i + 0.5) / 1000, 1, false, 0, pieces[0].layer_materials});
  for (const WantedBead& piece : pieces_of({{1, 20}}, palette)) {
    if (piece.weight == 1) pieces.push_back(piece);
  }
  const auto switches = scheduled(palette, pieces, {chamber, 0.5, true});
  const auto mixing = forecast_of(palette, pieces, switches, chamber);
  CHECK(mixing.misplaced / 100 < 0.011);
  const auto naive = scheduled(palette, pieces, {chamber, 0.5, false});
  CHECK(forecast_of(palette, pieces, naive, chamber).misplaced > 3 * mixing.misplaced);
  CHECK(switches.size() <= 2 + Palette::steps + 1);
  for (std::size_t i = 1; i < switches.size(); ++i) {
    CHECK(misplaced(palette.mixture(switches[i].shade).shares(),
                    palette.mixture(switches[i - 1].shade).shares()) < 2.1 / Palette::steps);
  }
}

TEST_CASE("without look-ahead the switch is at the border") {
  const Palette palette = palette_of(two);
  const auto switches =
      scheduled(palette, pieces_of({{0, 10}, {1, 0.2}, {0, 5}}, palette), {{2.1, 4.0, 3}, 0.5, false});
  REQUIRE(switches.size() == 3);
  CHECK(switches[1].at == Approx(primed + 10));
  CHECK(switches[2].at == Approx(primed + 10.2));
}
