#include "host/tune/transition_fit.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/error.hpp"
#include "host/tune/reading.hpp"
#include "tests/host/support/hidden_nozzles.hpp"

namespace unicursal::host {
namespace {

using test::HiddenNozzle;

/// Of whole tanks, by the sum that such a row of them has: 1 − e^−x·Σ x^j/j!
double arrived(const HiddenNozzle& nozzle, double passed) {
  const auto through = [&](double x) {
    double term = std::exp(-x), rest = 0;
    for (std::size_t j = 0; j < nozzle.tanks; ++j) {
      rest += term;
      term *= x / static_cast<double>(j + 1);
    }
    return 1 - rest;
  };
  double low = 0, high = 100;
  for (int i = 0; i < 60; ++i) (through((low + high) / 2) < 0.95 ? low : high) = (low + high) / 2;
  return passed < nozzle.dead ? 0 : through((passed - nozzle.dead) * low / nozzle.mixing);
}

/// The volume after which so much of the change has come.
double passed_at(const HiddenNozzle& nozzle, double change) {
  double low = 0, high = 200;
  for (int i = 0; i < 60; ++i) {
    (arrived(nozzle, (low + high) / 2) < change ? low : high) = (low + high) / 2;
  }
  return low;
}

/// mm along the strip after which so much has passed.
double along_at(const Strip& strip, double passed) {
  double low = 0, high = strip.length();
  for (int i = 0; i < 60; ++i) {
    (strip.at((low + high) / 2).passed < passed ? low : high) = (low + high) / 2;
  }
  return low;
}

/// As an eye does that takes `eye` of the change for what the lines show.
StripReading read_by_ticks(const Strip& strip, const HiddenNozzle& nozzle, const Perception& eye = {}) {
  const auto tick = [&](double change) {
    return nearest_tick(strip, along_at(strip, passed_at(nozzle, change)));
  };
  return {tick(eye.began), tick(eye.stopped), tick(eye.half)};
}

double error_of(const Transition& found, const HiddenNozzle& nozzle) {
  const double worse =
      std::max(std::abs(found.dead.value - nozzle.dead), std::abs(found.mixing.value - nozzle.mixing));
  return worse / (nozzle.dead + nozzle.mixing);
}

gcode::Printer diamond() {
  gcode::Printer printer;
  printer.nozzle = 0.6;
  printer.bead_width_range = {0.36, 1.6};
  return printer;
}

}  // namespace

TEST_CASE("Quantiles of the gamma distribution agree with the tables") {
  CHECK(gamma_quantile(1, 0.95) == Approx(-std::log(0.05)).epsilon(1e-10));
  CHECK(gamma_quantile(2, 0.95) == Approx(4.743864518).epsilon(1e-9));
  CHECK(gamma_quantile(6, 0.05) == Approx(2.613014744).epsilon(1e-9));
  CHECK(gamma_quantile(2.5, 0.5) == Approx(4.351460191 / 2).epsilon(1e-9));  // chi-square, 5 degrees
}

TEST_CASE("Readings without rounding give the volumes back, whatever the number of tanks") {
  for (const HiddenNozzle& nozzle : test::extreme_nozzles()) {
    CAPTURE(nozzle.dead, nozzle.mixing, nozzle.tanks);
    const auto exactly = [&](double change) {
      const double passed = passed_at(nozzle, change);
      return VolumeRange{passed - 1e-4, passed + 1e-4};
    };
    const Transition found = fit_transition({exactly(0.05), exactly(0.95), exactly(0.5)});
    CHECK(error_of(found, nozzle) < 0.001);
  }
}

TEST_CASE("Readings by ticks give every nozzle within a tenth, and the truth is within the uncertainty") {
  const Strip strip = make_strip(diamond(), {});
  std::vector<HiddenNozzle> nozzles = test::hidden_nozzles(300, 1);
  const std::vector<HiddenNozzle> extremes = test::extreme_nozzles();
  nozzles.insert(nozzles.end(), extremes.begin(), extremes.end());
  for (const HiddenNozzle& nozzle : nozzles) {
    CAPTURE(nozzle.dead, nozzle.mixing, nozzle.tanks);
    const Transition found = fit_transition(volumes_of(strip, read_by_ticks(strip, nozzle)));
    CHECK(error_of(found, nozzle) < 0.1);
    CHECK(std::abs(found.dead.value - nozzle.dead) <= found.dead.uncertainty + 1e-3);
    CHECK(std::abs(found.mixing.value - nozzle.mixing) <= found.mixing.uncertainty + 1e-3);
    CHECK(found.widened == 1);
  }
}

TEST_CASE("An eye that compares to one in a hundred is good enough") {
  const Strip strip = make_strip(diamond(), {});
  for (const Perception& eye : {Perception{0.04, 0.49, 0.94}, Perception{0.06, 0.51, 0.96}}) {
    for (const HiddenNozzle& nozzle : test::hidden_nozzles(100, 9)) {
      CAPTURE(eye.began, nozzle.dead, nozzle.mixing, nozzle.tanks);
      const Transition found = fit_transition(volumes_of(strip, read_by_ticks(strip, nozzle, eye)));
      CHECK(error_of(found, nozzle) < 0.1);
    }
  }
}

TEST_CASE("Without the half reading, the uncertainty includes the number of tanks") {
  const Strip strip = make_strip(diamond(), {});
  for (const std::size_t tanks : {1, 6}) {
    const HiddenNozzle nozzle{5, 20, tanks};
    StripReading reading = read_by_ticks(strip, nozzle);
    const Transition fine = fit_transition(volumes_of(strip, reading));
    reading.half.reset();
    const Transition rough = fit_transition(volumes_of(strip, reading));
    CHECK(rough.mixing.uncertainty > 2 * fine.mixing.uncertainty);
    CHECK(std::abs(rough.mixing.value - nozzle.mixing) <= rough.mixing.uncertainty);
    // Where it ends is known all the same.
    CHECK(rough.dead.value + rough.mixing.value == Approx(25).epsilon(0.02));
  }
}

TEST_CASE("Readings that disagree a little are widened, impossible ones refused") {
  const auto about = [](double passed) { return VolumeRange{passed - 0.1, passed + 0.1}; };
  // One tank has its half at 22 % of the way, the least there is.
  const Transition found = fit_transition({about(2), about(12), about(3.9)});
  CHECK(found.widened > 1);
  CHECK(found.mixing.value == Approx(10).margin(1));
  CHECK_THROWS_AS(fit_transition({about(2), about(12), about(9)}), core::DataError);
}

}  // namespace unicursal::host
