#include "host/tune/curve_fit.hpp"

#include <algorithm>
#include <boost/math/special_functions/gamma.hpp>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <random>

#include "core/error.hpp"
#include "host/tune/joint_fit.hpp"
#include "tests/host/support/hidden_nozzles.hpp"

namespace unicursal::host {
namespace {

using test::HiddenNozzle;

/// Two filaments under another law than the fit assumes: cube roots of the light are averaged (Yule and
/// Nielsen, n = 3), after the stronger filament's share has been counted more.
struct Pair {
  Seen from, to;
  double strength;  ///< of the second filament
};

const Pair pairs[] = {{{0.25, 0.36, 0.62}, {0.66, 0.3, 0.26}, 1.6},
                      {{0.85, 0.83, 0.8}, {0.6, 0.25, 0.22}, 4},
                      {{0.3, 0.55, 0.3}, {0.55, 0.22, 0.5}, 0.8}};

Seen mixed(const Pair& pair, double share, double paler) {
  const double part = share * pair.strength / (share * pair.strength + 1 - share);
  Seen seen{};
  for (std::size_t c = 0; c < 3; ++c) {
    const double from = std::pow(pair.from[c], 2.2 / 3), to = std::pow(pair.to[c], 2.2 / 3);
    seen[c] = std::pow(from + part * (to - from), 3 / 2.2) * (1 - paler) + paler * 0.7;
  }
  return seen;
}

double arrived(const HiddenNozzle& nozzle, double passed) {
  const auto tanks = static_cast<double>(nozzle.tanks);
  const double whole = boost::math::gamma_p_inv(tanks, 0.95);
  const double part = (passed - nozzle.dead) / nozzle.mixing;
  return part <= 0 ? 0 : boost::math::gamma_p(tanks, whole * part);
}

class Noise {
 public:
  explicit Noise(double size) : size_(size) {}
  double operator()() {
    double sum = 0;
    for (int i = 0; i < 12; ++i) sum += static_cast<double>(chance_()) / 4294967296.0;
    return size_ * (sum - 6);
  }

 private:
  std::mt19937 chance_{3};
  double size_;
};

struct SeenStrip {
  std::vector<CurvePoint> points;
  std::vector<MixtureSwitch> switches;
  ReferenceColours references;

  CurveFit fit() const { return fit_curve(points, switches, references, "strip.jpg"); }
};

/// Lanes that fill the nozzle with the mixtures of the reference lines, fat and in the end thin, and then the
/// strip: thin up to 12 mm³, where the bed shines through, and then fat.
SeenStrip seen_strip(const HiddenNozzle& nozzle, const Pair& pair, double noise_size, double range = 60) {
  constexpr double filling = 72, thin_end = 2.2;
  Noise noise(noise_size);
  SeenStrip strip;
  const std::array<double, 5> steps = {0.05, 0.45, 0.45, 0.05, -1};
  for (std::size_t i = 0; i < steps.size(); ++i)
    strip.switches.push_back({filling * (static_cast<double>(i) - 5), steps[i]});
  strip.switches.push_back({0, 1});
  const auto add = [&](double passed, double fat, std::size_t lane) {
    double share = 0;
    for (const MixtureSwitch& one : strip.switches) share += one.step * arrived(nozzle, passed - one.passed);
    Seen colour = mixed(pair, share, 0.12 * (1 - fat));
    for (double& channel : colour) channel += noise();
    // Lanes of 72 mm³ and 180 mm lie 5 mm apart.
    const double along = (passed - filling * (static_cast<double>(lane) - 5)) / filling;
    strip.points.push_back({passed, colour, fat, 1, {}, lane, {180 * along, 5 * static_cast<double>(lane)}});
  };
  for (std::size_t i = 0; i < steps.size(); ++i) {
    for (double passed = 0.12; passed < filling; passed += passed < filling - thin_end ? 0.24 : 0.09)
      add(filling * (static_cast<double>(i) - 5) + passed, passed < filling - thin_end ? 1 : 0, i);
  }
  for (double passed = 0.02; passed < range; passed += passed < 12 ? 0.05 : 0.12)
    add(passed, passed < 12 ? 0 : 1, steps.size());
  for (const double fat : {0.0, 1.0}) {
    ReferenceColours::Lines& lines = fat > 0 ? strip.references.fat : strip.references.thin;
    for (std::size_t i = 0; i < shade_count; ++i) {
      lines.colour[i] = mixed(pair, shade_shares[i], 0.12 * (1 - fat));
      lines.doubt[i] = 0.001;
    }
  }
  return strip;
}

}  // namespace

TEST_CASE("A curve gives the volumes of hidden nozzles within a twentieth, under another law of colours",
          "[optimised]") {
  std::size_t within = 0, tanks_within = 0, all = 0;
  for (const HiddenNozzle& nozzle : test::hidden_nozzles(6, 7)) {
    for (const Pair& pair : pairs) {
      CAPTURE(nozzle.dead, nozzle.mixing, nozzle.tanks, pair.strength);
      const SeenStrip strip = seen_strip(nozzle, pair, 0.004);
      const CurveFit fit = strip.fit();
      const double whole = nozzle.dead + nozzle.mixing;
      const double error =
          std::max(std::abs(fit.dead.value - nozzle.dead), std::abs(fit.mixing.value - nozzle.mixing));
      CHECK(error < 0.1 * whole);
      within += error < 0.05 * whole ? 1 : 0;
      tanks_within += std::abs(fit.tanks.value - static_cast<double>(nozzle.tanks)) <=
                              std::max(0.5, fit.tanks.uncertainty)
                          ? 1
                          : 0;
      ++all;
    }
  }
  CHECK(within * 100 >= 90 * all);
  CHECK(tanks_within * 100 >= 75 * all);
}

TEST_CASE("More noise gives more uncertainty", "[optimised]") {
  const HiddenNozzle nozzle{4, 10, 3};
  const SeenStrip quiet = seen_strip(nozzle, pairs[0], 0.001), loud = seen_strip(nozzle, pairs[0], 0.02);
  const CurveFit sure = quiet.fit(), unsure = loud.fit();
  CHECK(unsure.mixing.uncertainty > 1.2 * sure.mixing.uncertainty);
  CHECK(unsure.tanks.uncertainty > sure.tanks.uncertainty);
  CHECK(std::abs(unsure.mixing.value - 10) < unsure.mixing.uncertainty);
  CHECK(unsure.scatter == Approx(0.02).epsilon(0.3));
}

TEST_CASE("Glare on a tenth of the bead does not change the result") {
  const HiddenNozzle nozzle{4, 10, 3};
  SeenStrip strip = seen_strip(nozzle, pairs[0], 0.003);
  const CurveFit before = strip.fit();
  for (std::size_t i = 700; i < 700 + strip.points.size() / 10; ++i) {
    for (double& channel : strip.points[i].colour) channel += 0.3;
  }
  const CurveFit after = strip.fit();
  CHECK(after.dead.value == Approx(before.dead.value).margin(0.4));
  CHECK(after.mixing.value == Approx(before.mixing.value).margin(0.8));
}

TEST_CASE("Light that rises over the bed, and lanes that are darker than others, do not falsify the volumes",
          "[optimised]") {
  const HiddenNozzle nozzle{4, 10, 3};
  SeenStrip strip = seen_strip(nozzle, pairs[0], 0.003);
  const double sure = strip.fit().mixing.uncertainty;
  const std::array<double, 6> lanes = {0, 0.03, -0.03, 0, 0.03, -0.02};
  for (CurvePoint& point : strip.points) {
    // Along the change from tick 0 to its end, by a tenth of what the change does to the colours.
    const double light = 1 + 0.0006 * point.place.x() + 0.002 * point.place.y() + lanes.at(point.lane);
    for (double& channel : point.colour) channel *= std::pow(light, 1 / 2.2);
  }
  const CurveFit fit = strip.fit();
  CHECK(fit.dead.value == Approx(nozzle.dead).margin(0.3));
  CHECK(fit.mixing.value == Approx(nozzle.mixing).margin(0.5));
  CHECK(fit.mixing.uncertainty >= sure);
}

TEST_CASE("A strip whose colours say too little about the volumes is refused", "[optimised]") {
  SeenStrip strip = seen_strip({0.4, 0.8, 1}, pairs[0], 0.05);
  CHECK_THROWS_WITH(strip.fit(), Catch::Contains("uncertain"));
}

TEST_CASE("A strip that ends too early, or shows something else, is refused") {
  const SeenStrip early = seen_strip({10, 25, 1}, pairs[0], 0.002, 25);
  CHECK_THROWS_WITH(early.fit(), Catch::Contains("larger --range"));
  SeenStrip other = seen_strip({4, 10, 2}, pairs[0], 0.002);
  std::mt19937 chance(1);
  for (CurvePoint& point : other.points) {
    for (double& channel : point.colour) channel = static_cast<double>(chance()) / 4294967296.0;
  }
  CHECK_THROWS_AS(other.fit(), core::DataError);
}

TEST_CASE("Points that could not be measured do not count, and too many of them are refused") {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  SeenStrip without = seen_strip({4, 10, 2}, pairs[0], 0.002), broken = without;
  // In the middle of the change; at these places the light, the colour and the width are not known.
  const std::size_t last = broken.points.size() - 1;
  for (std::size_t i = 0; i < 3; ++i) without.points[last - 330 - i].trust = 0;
  broken.points[last - 330].brightness[0] = nan;
  broken.points[last - 331].colour[0] = nan;
  broken.points[last - 332].fat = std::numeric_limits<double>::infinity();
  const CurveFit fit = broken.fit(), wanted = without.fit();
  CHECK(fit.dead.value == Approx(wanted.dead.value));
  CHECK(fit.mixing.value == Approx(wanted.mixing.value));
  CHECK(fit.mixing.uncertainty == Approx(wanted.mixing.uncertainty));
  for (CurvePoint& point : broken.points) point.colour[2] = nan;
  CHECK_THROWS_AS(broken.fit(), core::DataError);
}

TEST_CASE("A strip that shows only the colour after its change does not determine the volumes") {
  SeenStrip strip = seen_strip({4, 10, 2}, pairs[0], 0.002);
  for (CurvePoint& point : strip.points) point.trust = point.passed > 45 ? 1 : 0;
  CHECK_THROWS_WITH(strip.fit(), Catch::Contains("too uncertain"));
}

TEST_CASE("Doubts are infinite if points say nothing about a nozzle, or are not numbers") {
  SeenStrip strip = seen_strip({4, 10, 2}, pairs[0], 0.002);
  const ColourAnswer answer(strip.references);
  const auto fitted = [&] {
    JointFit fit(strip.points, strip.switches, answer, {3, 8, 3}, 0.01);
    fit.improve(3);
    CHECK(possible(fit.nozzle()));
    return fit.doubts();
  };
  const auto infinite = [](const FittedNozzle& doubts) {
    return std::isinf(doubts.dead) && std::isinf(doubts.mixing) && std::isinf(doubts.tanks);
  };
  const FittedNozzle known = fitted();
  CHECK(known.dead > 0);
  CHECK(known.dead < 1);
  CHECK(known.mixing < 1);
  strip.points[900].brightness[0] = std::numeric_limits<double>::quiet_NaN();
  CHECK(infinite(fitted()));
  for (CurvePoint& point : strip.points) point.trust = 0;
  CHECK(infinite(fitted()));
}

TEST_CASE("A nozzle is possible within the limits of the fit only") {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN(),
                   infinity = std::numeric_limits<double>::infinity();
  CHECK(possible({0, 0.05, 1}));
  CHECK(possible({10, 25, 6}));
  for (const FittedNozzle& nozzle :
       {FittedNozzle{nan, 1, 2}, FittedNozzle{1, nan, 2}, FittedNozzle{1, 1, nan},
        FittedNozzle{infinity, 1, 2}, FittedNozzle{1, infinity, 2}, FittedNozzle{-0.1, 1, 2},
        FittedNozzle{1, 0.04, 2}, FittedNozzle{1, 1, 0.9}, FittedNozzle{1, 1, 6.1}}) {
    CAPTURE(nozzle.dead, nozzle.mixing, nozzle.tanks);
    CHECK_FALSE(possible(nozzle));
  }
}

TEST_CASE("Colours of the reference lines are given back exactly, and colours between them lie between") {
  const SeenStrip strip = seen_strip({4, 10, 2}, pairs[1], 0);
  const ColourAnswer answer(strip.references);
  for (const double fat : {0.0, 1.0}) {
    const ReferenceColours::Lines& lines = fat > 0 ? strip.references.fat : strip.references.thin;
    for (std::size_t i = 0; i < shade_count; ++i) {
      // Line 95 is nearly line 100 here, so that the rule of even steps has a say.
      for (std::size_t c = 0; c < 3; ++c)
        CHECK(answer(shade_shares[i], fat)[c] == Approx(lines.colour[i][c]).margin(i == 3 ? 0.004 : 1e-4));
    }
    CHECK(answer.change(answer(0, fat), fat) == Approx(0).margin(1e-9));
    CHECK(answer.change(answer(1, fat), fat) == Approx(1));
    double before = -1;
    for (double share = 0.005; share < 1; share += 0.01) {
      const double change = answer.change(answer(share, fat), fat);
      CHECK(change > before);
      before = change;
    }
  }
}

}  // namespace unicursal::host
