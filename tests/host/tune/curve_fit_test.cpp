#include "host/tune/curve_fit.hpp"

#include <algorithm>
#include <boost/math/special_functions/gamma.hpp>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "core/error.hpp"
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
  ReferenceColours references;
};

/// Thin up to 12 mm³, where the bed shines through, and then fat.
SeenStrip seen_strip(const HiddenNozzle& nozzle, const Pair& pair, double noise_size, double range = 60) {
  Noise noise(noise_size);
  SeenStrip strip;
  const auto seen = [&](double share, double fat) {
    Seen colour = mixed(pair, share, 0.12 * (1 - fat));
    for (double& channel : colour) channel += noise();
    return colour;
  };
  for (double passed = 0.02; passed < range;) {
    const double fat = passed < 12 ? 0 : 1;
    strip.points.push_back({passed, seen(arrived(nozzle, passed), fat), fat, 1, {}, 0});
    passed += fat > 0 ? 0.12 : 0.05;
  }
  const double shares[] = {0, 0.05, 0.5, 0.95, 1};
  for (const double fat : {0.0, 1.0}) {
    ReferenceColours::Lines& lines = fat > 0 ? strip.references.fat : strip.references.thin;
    for (std::size_t i = 0; i < shade_count; ++i) {
      lines.colour[i] = mixed(pair, shares[i], 0.12 * (1 - fat));
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
      const CurveFit fit = fit_curve(strip.points, strip.references, "strip.jpg");
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
  const CurveFit sure = fit_curve(quiet.points, quiet.references, "strip.jpg"),
                 unsure = fit_curve(loud.points, loud.references, "strip.jpg");
  CHECK(unsure.mixing.uncertainty > 1.2 * sure.mixing.uncertainty);
  CHECK(unsure.tanks.uncertainty > sure.tanks.uncertainty);
  CHECK(std::abs(unsure.mixing.value - 10) < unsure.mixing.uncertainty);
  CHECK(unsure.scatter == Approx(0.02).epsilon(0.3));
}

TEST_CASE("Glare on a tenth of the bead does not change the result") {
  const HiddenNozzle nozzle{4, 10, 3};
  SeenStrip strip = seen_strip(nozzle, pairs[0], 0.003);
  const CurveFit before = fit_curve(strip.points, strip.references, "strip.jpg");
  for (std::size_t i = 90; i < 90 + strip.points.size() / 10; ++i) {
    for (double& channel : strip.points[i].colour) channel += 0.3;
  }
  const CurveFit after = fit_curve(strip.points, strip.references, "strip.jpg");
  CHECK(after.dead.value == Approx(before.dead.value).margin(0.4));
  CHECK(after.mixing.value == Approx(before.mixing.value).margin(0.8));
}

TEST_CASE("A strip that ends too early, or shows something else, is refused") {
  const SeenStrip early = seen_strip({10, 25, 1}, pairs[0], 0.002, 25);
  CHECK_THROWS_WITH(fit_curve(early.points, early.references, "strip.jpg"),
                    Catch::Contains("larger --range"));
  SeenStrip other = seen_strip({4, 10, 2}, pairs[0], 0.002);
  std::mt19937 chance(1);
  for (CurvePoint& point : other.points) {
    for (double& channel : point.colour) channel = static_cast<double>(chance()) / 4294967296.0;
  }
  CHECK_THROWS_AS(fit_curve(other.points, other.references, "strip.jpg"), core::DataError);
}

TEST_CASE("Colours of the reference lines are given back exactly, and colours between them lie between") {
  const SeenStrip strip = seen_strip({4, 10, 2}, pairs[1], 0);
  const ColourAnswer answer(strip.references);
  for (const double fat : {0.0, 1.0}) {
    const ReferenceColours::Lines& lines = fat > 0 ? strip.references.fat : strip.references.thin;
    const double shares[] = {0, 0.05, 0.5, 0.95, 1};
    for (std::size_t i = 0; i < shade_count; ++i) {
      // Line 95 is nearly line 100 here, so that the rule of even steps has a say.
      for (std::size_t c = 0; c < 3; ++c)
        CHECK(answer(shares[i], fat)[c] == Approx(lines.colour[i][c]).margin(i == 3 ? 0.004 : 1e-4));
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
