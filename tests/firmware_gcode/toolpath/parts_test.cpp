#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <random>

#include "core/error.hpp"
#include "firmware_gcode/dialect/number.hpp"
#include "firmware_gcode/motion/laying_speed.hpp"
#include "firmware_gcode/motion/speeds.hpp"
#include "firmware_gcode/print/mixture.hpp"

using namespace unicursal;
using namespace unicursal::gcode;

TEST_CASE("numbers are as short as their precision allows") {
  CHECK(short_number(0, 3) == "0");
  CHECK(short_number(1.25, 3) == "1.25");
  CHECK(short_number(-0.5, 3) == "-.5");
  CHECK(short_number(0.001, 3) == ".001");
  CHECK(short_number(-0.0004, 3) == "0");
  CHECK(short_number(100, 3) == "100");
  CHECK(short_number(12.0305, 4) == "12.0305");
  CHECK(short_number(0.99996, 4) == "1");
  CHECK(short_number(7.6, 0) == "8");
}

TEST_CASE("numbers read back as what they were rounded to") {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> values(-300, 300);
  for (int i = 0; i < 20000; ++i) {
    const double value = values(random);
    const int decimals = static_cast<int>(random() % 6);
    CHECK(std::abs(std::stod(short_number(value, decimals)) - value) <= 0.5000001 * std::pow(10, -decimals));
  }
}

TEST_CASE("mixtures are shares at any scale") {
  CHECK(Mixture({10, 30, 0}).share(1) == Approx(0.75));
  CHECK_THROWS_WITH(Mixture({0, 0, 0}), Catch::Contains("all shares are zero"));
  CHECK_THROWS_WITH(Mixture({1e308, 1e308, 0}), Catch::Contains("too large"));
  CHECK_THROWS_AS(Mixture({0.5, -0.1, 0.6}), core::DataError);
  CHECK_THROWS_AS(Mixture({0.5, std::nan(""), 0.6}), core::DataError);
  CHECK_THROWS_AS(Mixture({std::numeric_limits<double>::infinity(), 0, 0}), core::DataError);
}

TEST_CASE("a floor raises idle feeders and keeps the proportion of the others") {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> shares(0, 1), floors(0, 1);
  for (int i = 0; i < 2000; ++i) {
    Shares given = Shares::zeros(least_feeders + random() % (most_feeders - 1));
    for (double& share : given) share = random() % 3 ? shares(random) : 0;
    given[0] += 0.001;
    const Mixture mixture(given);
    const double floor = floors(random) / static_cast<double>(mixture.feeders());
    const Mixture floored = mixture.with_floor(floor);
    double sum = 0;
    for (std::size_t a = 0; a < mixture.feeders(); ++a) {
      sum += floored.share(a);
      CHECK(floored.share(a) >= floor - 1e-12);
      for (std::size_t b = 0; b < mixture.feeders(); ++b) {
        if (floored.share(a) < floor + 1e-9 || floored.share(b) < floor + 1e-9) continue;
        CHECK(floored.share(a) * mixture.share(b) == Approx(floored.share(b) * mixture.share(a)));
      }
    }
    CHECK(sum == Approx(1));
  }
  CHECK(Mixture({1, 0, 0}).with_floor(1.0 / 3).share(0) == Approx(1.0 / 3));
  CHECK(Mixture({0.2, 0.3, 0.5}).with_floor(0) == Mixture({0.2, 0.3, 0.5}));
}

TEST_CASE("the bead speed gives the requested flow within the axes' limits") {
  Printer printer;               // 150 mm/s in x and y; beads of 0.24 to 1 mm
  const PrintSettings settings;  // 2 mm³/s
  const LayingSpeed pace(printer, settings);
  CHECK(pace.speed({2, 0}, 2 * 0.4 * 0.2, 1, 0.2) == Approx(2 / (0.4 * 0.2)));
  CHECK(pace.speed({3, 4}, 5 * 0.4 * 0.2, 1, 0.2) == Approx(25));
  CHECK(pace.speed({3, 4}, 5 * 1.6 * 0.2, 1, 0.2) == Approx(2 / (1.6 * 0.2)));  // too wide keeps the flow
  CHECK(pace.speed({1, 0}, 0.1 * 0.2, 1, 0.2) == Approx(2 / (0.24 * 0.2)));     // too thin runs no faster
  CHECK(pace.speed({1, 0}, 0, 1, 0.05) == Approx(150));
  CHECK(pace.speed({1, 1}, 0, 1, 0.03) == Approx(150 * std::sqrt(2)));
  CHECK(axis_limited_speed({3, 4}, {30, 100, 10}) == Approx(50));
}
