// Fits of filaments, to printers whose optics are other than the model's (other_optics.hpp).
#include "core/picture/fit_filaments.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <random>
#include <vector>

#include "core/picture/nearest_shares.hpp"
#include "tests/core/picture/other_optics.hpp"

using namespace unicursal::picture;
using unicursal::test::Dye;
using unicursal::test::OtherOptics;

namespace {

using Shares = std::vector<double>;

Shares with_floor(Shares parts) {
  constexpr double floor = 0.02;
  double sum = 0;
  for (const double part : parts) sum += part;
  for (double& part : parts) part = floor + (1 - floor * double(parts.size())) * part / sum;
  return parts;
}

/// Each filament twice, steps between every two, and mixtures of three.
std::vector<Shares> chart(std::size_t filaments) {
  std::vector<Shares> all;
  const std::vector<double> steps =
      filaments == 2 ? Shares{0.06, 0.15, 0.3, 0.5, 0.7, 0.85, 0.94} : Shares{0.2, 0.5, 0.8};
  for (std::size_t a = 0; a < filaments; ++a) {
    Shares pure(filaments);
    pure[a] = 1;
    all.insert(all.end(), 2, with_floor(pure));
    for (std::size_t b = a + 1; b < filaments; ++b) {
      for (const double step : steps) {
        Shares pair(filaments);
        pair[a] = 1 - step, pair[b] = step;
        all.push_back(with_floor(pair));
      }
      for (std::size_t c = b + 1; c < filaments; ++c) {
        Shares three(filaments);
        three[a] = three[b] = three[c] = 1;
        all.push_back(with_floor(three));
        for (const std::size_t most : {a, b, c}) {
          if (filaments > 3) break;
          Shares uneven = three;
          uneven[most] = 3;
          all.push_back(with_floor(uneven));
        }
      }
    }
  }
  return all;
}

struct Printer {
  Printer(const std::vector<Dye>& dyes, unsigned seed) : random(seed), optics(filaments(dyes, random)) {
    for (std::size_t f = 0; f < dyes.size(); ++f) pure.push_back(colour_of(optics.pure(f)));
  }

  static std::vector<unicursal::test::Pigments> filaments(const std::vector<Dye>& dyes,
                                                          std::mt19937& random) {
    std::vector<unicursal::test::Pigments> all;
    for (const Dye dye : dyes) all.push_back(pigments_of(dye, random));
    return all;
  }

  /// With noise of a ΔE of about 1.
  std::vector<MeasuredMixture> measured(const std::vector<Shares>& mixtures) {
    std::normal_distribution<double> noise(0, 0.6);
    std::vector<MeasuredMixture> all;
    for (const Shares& shares : mixtures) {
      Lab lab = lab_of(optics.light(shares));
      lab.lightness += noise(random), lab.a += noise(random), lab.b += noise(random);
      all.push_back({shares, light_of(lab), 1});
    }
    return all;
  }

  std::vector<Shares> any_mixtures(std::size_t count) {
    std::exponential_distribution<double> part(1);
    std::vector<Shares> all(count, Shares(pure.size()));
    for (Shares& shares : all) {
      for (double& share : shares) share = part(random);
      shares = with_floor(shares);
    }
    return all;
  }

  /// How far mixtures that the model did not see lie from what it foretells.
  double median_error(const Filaments& model) {
    std::vector<double> far;
    for (const Shares& shares : any_mixtures(101))
      far.push_back(difference(lab_of(optics.light(shares)), lab_of(mixed_light(shares, model))));
    std::nth_element(far.begin(), far.begin() + 50, far.end());
    return far[50];
  }

  /// How far the colour that is printed lies from the one that was asked for.
  double median_miss(const Filaments& model) {
    std::vector<double> far;
    for (const Shares& mixture : any_mixtures(21)) {
      const Lab wanted = lab_of(optics.light(mixture));
      const NearestShares found = nearest_shares(wanted, model, pure.size(), 0.02);
      far.push_back(difference(wanted, lab_of(optics.light(found.shares))));
    }
    std::nth_element(far.begin(), far.begin() + 10, far.end());
    return far[10];
  }

  std::mt19937 random;
  OtherOptics optics;
  std::vector<Colour> pure;
};

}  // namespace

TEST_CASE("after a fit to a chart, other optics are foretold and colours come out as wanted") {
  const std::vector<Dye> dyes =
      GENERATE(std::vector<Dye>{Dye::yellow, Dye::blue}, std::vector<Dye>{Dye::blue, Dye::red, Dye::white},
               std::vector<Dye>{Dye::cyan, Dye::magenta, Dye::yellow},
               std::vector<Dye>{Dye::white, Dye::black, Dye::red, Dye::yellow});
  for (const unsigned seed : {1U, 2U, 3U}) {
    Printer printer(dyes, seed);
    CAPTURE(dyes.size(), seed);
    // The profile names the filaments' colours only roughly.
    std::vector<Colour> named = printer.pure;
    for (Colour& colour : named) colour = lit(colour, 0.9);
    const auto fitted =
        fit_filaments(named, printer.measured(chart(dyes.size())), PureColours::fitted).value();
    const Filaments before(std::span<const Colour>(printer.pure));
    const Filaments after(std::span<const Colour>(fitted.pure), fitted.mixing);
    CHECK(printer.median_error(before) > 2);
    CHECK(printer.median_error(after) < 1);
    CHECK(printer.median_miss(after) < 1);
  }
}

TEST_CASE("a spoilt patch stands out and changes little") {
  Printer printer({Dye::blue, Dye::red, Dye::white}, 4);
  std::vector<MeasuredMixture> measured = printer.measured(chart(3));
  measured[7].light = {0.02, 0.9, 0.1};
  const auto fitted = fit_filaments(printer.pure, measured, PureColours::kept).value();
  CHECK(std::max_element(fitted.differences.begin(), fitted.differences.end()) ==
        fitted.differences.begin() + 7);
  CHECK(printer.median_error(Filaments(std::span<const Colour>(fitted.pure), fitted.mixing)) < 2);
}

TEST_CASE("a printer that mixes as usual stays near what is usual") {
  const std::vector<Colour> pure(usual_filaments.begin(), usual_filaments.begin() + 3);
  std::vector<MeasuredMixture> measured;
  for (const Shares& shares : chart(3)) measured.push_back({shares, mixed_light(shares, Filaments(pure)), 1});
  const auto fitted = fit_filaments(pure, measured, PureColours::kept).value();
  CHECK(fitted.pure == pure);
  CHECK(fitted.mixing.lift == Approx(Mixing::usual_lift).epsilon(0.01));
  for (const double far : fitted.differences) CHECK(far < 0.01);
}

TEST_CASE("mixtures that say nothing are refused") {
  Printer printer({Dye::blue, Dye::red, Dye::white}, 5);
  const std::vector<MeasuredMixture> whole = printer.measured(chart(3));
  const auto fit = [&](const std::vector<MeasuredMixture>& measured) {
    return fit_filaments(printer.pure, measured, PureColours::fitted);
  };
  CHECK(fit(whole));
  CHECK_FALSE(fit({}));
  CHECK_FALSE(fit({whole.begin(), whole.begin() + 4}));
  std::vector<MeasuredMixture> same = whole, without_white;
  for (MeasuredMixture& mixture : same) mixture.light = {0.2, 0.2, 0.2};
  CHECK_FALSE(fit(same));
  for (const MeasuredMixture& mixture : whole)
    if (mixture.shares[2] < 0.1) without_white.push_back(mixture);
  REQUIRE(without_white.size() >= 5);
  CHECK_FALSE(fit(without_white));
}

TEST_CASE("strengths and losses change a mixture as computed by hand") {
  const std::vector<Light> greys{{0.8, 0.8, 0.8}, {0.2, 0.2, 0.2}};
  Mixing mixing;
  mixing.lift = 0;
  const auto made = [&] {
    return mixed_light(Shares{0.5, 0.5}, Filaments(std::span<const Light>(greys), mixing));
  };
  // (1 - R)² / 2R is 0.025 and 1.6, on average 0.8125; 1 + 0.8125 - √(0.8125² + 1.625) = 0.3008.
  for (const double channel : made()) CHECK(channel == Approx(0.3008).margin(0.0005));
  // A lift of 0.05 makes them 0.8095 and 0.2381, the ratios 0.0224 and 1.2190, the mean 0.6207, and 0.3453 of
  // it is without the lift 0.3125.
  mixing.lift = 0.05;
  for (const double channel : made()) CHECK(channel == Approx(0.3125).margin(0.0005));
  mixing.lift = 0;
  const double loss = std::log(16.0);
  mixing.pairs = {{0, 1, {loss, loss, loss}}};
  for (const double channel : made()) CHECK(channel == Approx(0.3008 / 2).margin(0.0005));  // e^(-ln 16 / 4)
  // A strength of 3 makes it 1.20625, and the light 0.2396.
  mixing.strengths = {{1, 1, 1}, {3, 3, 3}};
  mixing.pairs[0].loss = {0, 0, 0};
  for (const double channel : made()) CHECK(channel == Approx(0.2396).margin(0.0005));
  // Of the light of 500 to 600 nm alone, which is green.
  mixing.pairs[0].loss = {0, loss, 0};
  CHECK(made()[1] < 0.2396 / 1.7);
  CHECK(made()[0] > 0.2396 / 1.2);
  CHECK(made()[2] > 0.2396 / 1.1);
}

TEST_CASE("the usual numbers, when they are written out, mix as they do when they are left out") {
  Mixing mixing;
  mixing.strengths.assign(4, {2, 2, 2});  // only their ratios matter
  mixing.pairs = {{0, 1, {0, 0, 0}}};
  const std::vector<Colour> pure{{240, 190, 40}, {38, 96, 196}, {214, 52, 48}, {20, 20, 20}};
  const Filaments written(std::span<const Colour>(pure), mixing), usual{std::span<const Colour>(pure)};
  for (const Shares& shares : chart(4)) {
    const Light one = mixed_light(shares, usual), other = mixed_light(shares, written);
    for (std::size_t c = 0; c < 3; ++c) CHECK(other[c] == Approx(one[c]).margin(1e-9));
  }
}
