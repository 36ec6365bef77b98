// Whole runs of the program with a profile that describes its filaments.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>

#include "core/picture/hex_colour.hpp"
#include "core/picture/reflectance.hpp"
#include "tests/host/support/child_process.hpp"
#include "tests/host/support/sample_job.hpp"
#include "tests/host/support/temp_folder.hpp"
#include "tests/paths.hpp"

namespace unicursal {
namespace {

using nlohmann::json;
using test::replaced;

constexpr std::array<const char*, 3> colours{"#f0be28", "#ffffff", "#2050c0"};
constexpr std::array<double, 3> densities{1.24, 1.04, 1.27};
constexpr std::array<double, 3> diameters{1.75, 1.70, 1.79};
constexpr std::array<double, 3> prices{20, 30, 40};

std::string profile() {
  std::string text =
      replaced(test::sample_profile, "max_flow = 5.0", "max_flow = 5.0\nflow_factors = [1, 1.03, 1]");
  for (std::size_t f = 0; f < 3; ++f)
    text += fmt::format(
        "[[filament]]\ncolour = \"{}\"\ndensity = {}\ndiameter = {}\nprice = {}\nname = \"spool {}\"\n",
        colours[f], densities[f], diameters[f], prices[f], f + 1);
  return text;
}

/// "green" is half yellow and half blue.
const std::string job = replaced(replaced(test::sample_job, "[0.6, 0.0, 0.2]", "[0.5, 0.0, 0.5]"),
                                 "flow = 3.0", "flow = 3.0\nskirt = 1");

double to_light(double value) {
  const double v = value / 255;
  return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

double from_light(double light) {
  return 255 * (light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055);
}

}  // namespace

TEST_CASE("Grams of each filament are those that the simulated printer's feeders have fed") {
  const test::TempFolder folder;
  folder.write("bench.toml", profile());
  folder.write("plate.svg", test::sample_drawing);
  const test::Outcome outcome = test::run(
      {"dry-run", folder.write("job.toml", job).string(), "--report", (folder / "report.json").string()});
  INFO(outcome.err);
  REQUIRE(outcome.code == 0);
  const json report = json::parse(test::read_text(folder / "report.json"));
  const json& used = report["filament"];
  REQUIRE(used["feeders"].size() == 3);
  double grams = 0, cost = 0, beside = 0;
  for (std::size_t f = 0; f < 3; ++f) {
    const json& one = used["feeders"][f];
    // The firmware counts lengths of a filament of the nominal diameter; the second feeder slips.
    const double turned = report["simulator"]["feeders"][f]["mm"].get<double>() / (f == 1 ? 1.03 : 1);
    const double area = std::numbers::pi / 4 * diameters[f] * diameters[f];
    CHECK(one["metres"].get<double>() == Approx(turned / 1000).epsilon(0.005));
    CHECK(one["grams"].get<double>() == Approx(turned * area * densities[f] / 1000).epsilon(0.005));
    CHECK(one["cost"].get<double>() == Approx(one["grams"].get<double>() * prices[f] / 1000));
    CHECK(one["name"] == fmt::format("spool {}", f + 1));
    CHECK(one["colour"] == colours[f]);
    grams += one["grams"].get<double>();
    cost += one["cost"].get<double>();
    beside += one["beside_part"]["grams"].get<double>() / densities[f];
  }
  CHECK(used["total"]["grams"].get<double>() == Approx(grams));
  CHECK(used["total"]["cost"].get<double>() == Approx(cost));
  CHECK(used["total"]["currency"] == "EUR");
  double prime = 0;
  for (const json& mixture : report["mixtures"]) prime += mixture["prime_mm3"].get<double>();
  CHECK(prime > 0);
  CHECK(beside * 1000 == Approx(prime).epsilon(1e-6));
  CHECK(outcome.out.find("filament:  spool 1: ") != std::string::npos);
  CHECK(outcome.out.find(fmt::format("in all: {:.2f} m, {:.1f} g, {:.2f} EUR (",
                                     used["total"]["metres"].get<double>(), grams, cost)) !=
        std::string::npos);
}

TEST_CASE("Green of yellow and blue filament is drawn green, as the optical model computes it") {
  const test::TempFolder folder;
  folder.write("bench.toml", profile());
  folder.write("plate.svg", test::sample_drawing);
  const auto file = folder.write("job.toml", job);
  const test::Outcome outcome = test::run({"curve", file.string(), "-o", (folder / "curve.svg").string()});
  INFO(outcome.err);
  REQUIRE(outcome.code == 0);
  // By hand, in each band: the mean of (1 - r)² ÷ 2r of both filaments, r being their reflectance lifted by a
  // twentieth, and back (core/picture/filaments.hpp).
  const picture::Light yellow{to_light(0xf0), to_light(0xbe), to_light(0x28)};
  const picture::Light blue{to_light(0x20), to_light(0x50), to_light(0xc0)};
  const picture::Reflectance of_yellow = picture::reflectance_of(yellow),
                             of_blue = picture::reflectance_of(blue);
  picture::Light light{};
  for (std::size_t band = 0; band < picture::bands; ++band) {
    const double y = (of_yellow[band] + 0.05) / 1.05, b = (of_blue[band] + 0.05) / 1.05;
    const double mean = ((1 - y) * (1 - y) / (2 * y) + (1 - b) * (1 - b) / (2 * b)) / 2;
    const double mixed = 1.05 * (1 + mean - std::sqrt(mean * mean + 2 * mean)) - 0.05;
    const double rest = (of_yellow[band] + of_blue[band]) / 2;  // what the guessed reflectances do not show
    for (std::size_t c = 0; c < 3; ++c) light[c] += picture::seen_of_band[c][band] * (mixed - rest);
  }
  for (std::size_t c = 0; c < 3; ++c) light[c] = from_light(light[c] + (yellow[c] + blue[c]) / 2);
  const auto byte = [&](std::size_t c) { return static_cast<std::uint8_t>(std::lround(light[c])); };
  const picture::Colour green{byte(0), byte(1), byte(2)};
  CHECK(green.g > green.r);
  CHECK(green.g > green.b);
  CHECK(test::read_text(folder / "curve.svg").find(picture::hex_of(green)) != std::string::npos);
}

TEST_CASE("the colours of a printer's filaments are listed, drawn, and found for a wanted colour") {
  const test::TempFolder folder;
  folder.write("bench.toml", profile());
  const std::string file = folder / "bench.toml", drawn = folder / "all.png";
  const test::Outcome list = test::run({"colours", file, "--picture", drawn});
  INFO(list.err);
  REQUIRE(list.code == 0);
  CHECK(list.out.find("feeder 1: #f0be28 spool 1\n") != std::string::npos);
  // Three steps between each of three pairs, one even mixture of all three; each has a name.
  CHECK(std::count(list.out.begin(), list.out.end(), '\n') == 3 + 9 + 1 + 1);
  CHECK(list.out.find("  teal\n") != std::string::npos);
  CHECK(test::read_text(drawn).starts_with("\x89PNG"));
  const test::Outcome some = test::run({"colours", file, "#70a060", "#ff00ff"});
  REQUIRE(some.code == 0);
  CHECK(some.out.find("#70a060 becomes #") != std::string::npos);
  CHECK(some.out.find("these filaments cannot make #ff00ff") != std::string::npos);
  const test::Outcome wrong = test::run({"colours", file, "#ffffff", "white"});
  CHECK(wrong.code == 2);
  CHECK(wrong.out.empty());
  CHECK(wrong.err.find("\"white\" is not a colour; write six hexadecimal digits") != std::string::npos);
}

}  // namespace unicursal
