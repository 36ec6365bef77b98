#include "firmware_gcode/mixing/overshoot.hpp"

#include <catch2/catch.hpp>
#include <numeric>
#include <random>

#include "firmware_gcode/mixing/forecast.hpp"
#include "firmware_gcode/mixing/schedule.hpp"

using namespace unicursal;
using namespace unicursal::gcode;

namespace {

constexpr double floor_share = 0.02;

Palette palette_of(const std::vector<Material>& materials) {
  return Palette(materials, [](const Mixture& m) {
    const Mixture written = m.with_floor(floor_share).quantised(4);
    return CalibratedMixture{written, written};
  });
}

const std::vector<Material> three = {{"orange", Mixture({0.5, 0.5, 0})},
                                     {"green", Mixture({0, 0.5, 0.5})},
                                     {"grey", Mixture({0.34, 0.33, 0.33})}};
const std::vector<Material> tints = {{"warm", Mixture({0.5, 0.3, 0.2})}, {"cold", Mixture({0.2, 0.3, 0.5})}};
const std::vector<Material> pure = {{"blue", Mixture({1, 0, 0})}, {"red", Mixture({0, 1, 0})}};

std::vector<WantedBead> pieces_of(const Palette& palette,
                                  const std::vector<std::pair<std::size_t, double>>& visits) {
  std::vector<std::size_t> all(palette.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  const LayerMaterials layer_materials = std::make_shared<const std::vector<std::size_t>>(all);
  constexpr double bead = 0.1;
  std::vector<WantedBead> pieces{
      {20, visits.front().first, 0, 0.02, false, 0, layer_materials}};  // fills the chamber
  for (const auto& [material, volume] : visits) {
    for (double done = 0; done < volume; done += bead)
      pieces.push_back({bead, material, 0, 1, false, 0, layer_materials});
  }
  return pieces;
}

std::vector<Switch> scheduled(const Palette& palette, const std::vector<WantedBead>& pieces,
                              const ChamberModel& profile, const Overshoots* overshoots) {
  Schedule schedule(palette, {profile, 0.5, true, overshoots});
  for (const WantedBead& piece : pieces) schedule.add(piece);
  schedule.end();
  return schedule.take();
}

/// What the switches come to in a nozzle that need not be the profile's.
LayerMixing laid(const Palette& palette, const std::vector<WantedBead>& pieces,
                 const std::vector<Switch>& switches, const ChamberModel& nozzle) {
  Forecast forecast(palette, nozzle);
  for (const WantedBead& piece : pieces) forecast.add(piece);
  for (const Switch& each : switches) forecast.add(each);
  return forecast.rest().back();
}

double loss(const LayerMixing& mixing) {
  return mixing.misplaced + mixing.wrong;
}

}  // namespace

TEST_CASE("a change past a third mixture goes round it") {
  const ChamberModel nozzle{2.1, 4.0, 2};
  const auto [palette, overshoots] = with_overshoots(palette_of(three), {nozzle, 0.5, floor_share, 15});
  REQUIRE(overshoots.between(0, 1));
  for (const auto& [from, to] : {std::pair<std::size_t, std::size_t>{0, 1}, {1, 0}}) {
    const auto pieces = pieces_of(palette, {{from, 20}, {to, 20}});
    const auto plain = laid(palette, pieces, scheduled(palette, pieces, nozzle, nullptr), nozzle);
    const auto hurried = laid(palette, pieces, scheduled(palette, pieces, nozzle, &overshoots), nozzle);
    CHECK(plain.wrong > 0.8);  // takes grey's colour for so many mm³
    CHECK(hurried.wrong < 0.1);
    CHECK(loss(hurried) < 0.5 * loss(plain));
  }
}

TEST_CASE("where the mixtures leave room, a change is a third sharper") {
  for (const ChamberModel& nozzle : {ChamberModel{2.1, 4.0, 2}, {0.5, 12, 3}}) {
    const auto [palette, overshoots] = with_overshoots(palette_of(tints), {nozzle, 0.5, floor_share, 15});
    const double room = 3 * (nozzle.dead_volume + nozzle.mixing_volume);
    const auto pieces = pieces_of(palette, {{0, room}, {1, room}, {0, room}});
    const auto plain = laid(palette, pieces, scheduled(palette, pieces, nozzle, nullptr), nozzle);
    const auto hurried = laid(palette, pieces, scheduled(palette, pieces, nozzle, &overshoots), nozzle);
    INFO(nozzle.mixing_volume << " mm³");
    CHECK(hurried.misplaced < 0.7 * plain.misplaced);
    CHECK(hurried.wrong < plain.wrong + 0.06 * nozzle.mixing_volume);
  }
}

TEST_CASE("pure mixtures leave nothing to overshoot") {
  const auto [palette, overshoots] = with_overshoots(palette_of(pure), {{2.1, 4.0, 2}, 0.5, floor_share, 15});
  CHECK_FALSE(overshoots.between(0, 1));
  CHECK(palette.added() == 0);
}

TEST_CASE("a nozzle that answers otherwise than its profile loses hardly anything by it") {
  const ChamberModel profile{2.1, 4.0, 2};
  for (const auto& materials : {three, tints, {three[0], three[2]}}) {
    const auto [palette, overshoots] =
        with_overshoots(palette_of(materials), {profile, 0.5, floor_share, 15});
    double plain_loss = 0, hurried_loss = 0;
    for (std::size_t to = 1; to < palette.size(); ++to) {
      const auto pieces = pieces_of(palette, {{0, 20}, {to, 20}, {0, 20}});
      const auto plain = scheduled(palette, pieces, profile, nullptr);
      const auto hurried = scheduled(palette, pieces, profile, &overshoots);
      for (const std::size_t tanks : {1u, 2u, 3u, 6u}) {
        for (const double factor : {0.8, 1.0, 1.2}) {
          const ChamberModel nozzle{factor * 2.1, factor * 4.0, tanks};
          const double without = loss(laid(palette, pieces, plain, nozzle)),
                       with = loss(laid(palette, pieces, hurried, nozzle));
          INFO(tanks << " tanks, volumes by " << factor << ", to " << materials[to].name);
          CHECK(with < 1.1 * without + 0.25);
          plain_loss += without, hurried_loss += with;
        }
      }
    }
    CHECK(hurried_loss < 0.97 * plain_loss);
  }
}

TEST_CASE("every pulse is a mixture that the printer may feed") {
  const auto [palette, overshoots] =
      with_overshoots(palette_of(three), {{2.1, 4.0, 3}, 0.5, floor_share, 15});
  CHECK(palette.added() > 0);
  CHECK(palette.size() + palette.added() <= 15);
  CHECK(palette.size() == 3);
  for (std::size_t from = 0; from < 3; ++from) {
    for (std::size_t to = 0; to < 3; ++to) {
      const Overshoot* overshoot = overshoots.between(from, to);
      if (!overshoot) continue;
      CHECK(overshoot->lead > 0);
      CHECK(overshoot->lead < 2.5 * 4);
      for (const Overshoot::Pulse& pulse : overshoot->pulses) {
        CHECK(pulse.volume > 0);
        for (const double share : palette.mixture(pulse.shade).shares()) CHECK(share > floor_share - 1e-4);
      }
    }
  }
}

TEST_CASE("there are pulses as far as tools go, and none beside gradients or without mixing") {
  const auto added = [](std::vector<Material> materials, const ChamberModel& nozzle, std::size_t most) {
    const auto [palette, overshoots] =
        with_overshoots(palette_of(materials), {nozzle, 0.5, floor_share, most});
    return palette.added();
  };
  const ChamberModel nozzle{2.1, 4.0, 2};
  CHECK(added(three, nozzle, 8) == 0);
  CHECK(added(three, nozzle, 9) > 0);
  CHECK(added(three, nozzle, 9) <= 6);
  CHECK(added(three, {2.1, 0, 2}, 15) == 0);
  // A floor share of a third leaves one mixture only.
  CHECK_FALSE(with_overshoots(palette_of(three), {nozzle, 0.5, 1.0 / 3, 15}).palette.added() > 1);
  CHECK(added({three[0]}, nozzle, 15) == 0);
  std::vector<Material> with_gradient = tints;
  with_gradient.push_back({"fade", Mixture({1, 0, 0}), Gradient{Mixture({0, 1, 0}), {1, 0, 0}, 0, 100}});
  CHECK(added(with_gradient, nozzle, 15) == 0);
}

TEST_CASE("what is decided with pulses does not depend on how the path comes in either") {
  const ChamberModel nozzle{2.1, 4.0, 2};
  const auto [palette, overshoots] = with_overshoots(palette_of(three), {nozzle, 0.5, floor_share, 15});
  std::mt19937 random(17);
  std::uniform_real_distribution<double> volume(0.3, 9);
  std::vector<std::pair<std::size_t, double>> visits;
  for (int i = 0; i < 60; ++i) visits.push_back({random() % 3, volume(random)});
  const auto pieces = pieces_of(palette, visits);
  const auto at_once = scheduled(palette, pieces, nozzle, &overshoots);
  Schedule schedule(palette, {nozzle, 0.5, true, &overshoots});
  std::vector<Switch> bit_by_bit;
  double certain = 0;
  const auto take = [&] {
    for (const Switch& each : schedule.take()) {
      CHECK(each.at >= certain);
      CHECK((bit_by_bit.empty() || each.at > bit_by_bit.back().at));
      bit_by_bit.push_back(each);
    }
    certain = schedule.certain();
  };
  for (const WantedBead& piece : pieces) {
    schedule.add(piece);
    if (random() % 5 == 0) take();
  }
  schedule.end();
  take();
  REQUIRE(bit_by_bit.size() == at_once.size());
  for (std::size_t i = 0; i < at_once.size(); ++i) {
    CHECK(bit_by_bit[i].at == at_once[i].at);
    CHECK(bit_by_bit[i].shade == at_once[i].shade);
  }
}
