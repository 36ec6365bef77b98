#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "core/error.hpp"
#include "firmware_gcode/dialect/dialect_named.hpp"
#include "firmware_gcode/dialect/share_writing.hpp"
#include "firmware_gcode/mixing/calibration.hpp"
#include "firmware_gcode/toolpath/placeholders.hpp"

using namespace unicursal;
using namespace unicursal::gcode;

TEST_CASE("Repetier gets shares in whole hundredths, at standstill") {
  const Dialect& repetier = dialect_named("repetier");
  CHECK(choose_extruder(repetier).empty());
  CHECK(begin_mixture(repetier, 3, Mixture({1, 1, 0})) == "T3");
  CHECK(repetier.define_tool(3, repetier.as_written(Mixture({0.5, 0.333, 0.167}))) ==
        std::vector<std::string>{"M400", "M163 S0 P50", "M163 S1 P33", "M163 S2 P17", "M164 S3"});
  CHECK(repetier.limits().tool_change_stops);
  CHECK_FALSE(dialect_named("marlin").limits().tool_change_stops);
  CHECK_THROWS_WITH(dialect_named("klipper"), Catch::Contains("klipper") && Catch::Contains("repetier"));
}

TEST_CASE("RepRapFirmware gets its shares at each change, and they add up to one") {
  const Dialect& dialect = dialect_named("reprapfirmware");
  const auto line = [&](const Shares& shares) {
    return begin_mixture(dialect, 9, dialect.as_written(Mixture(shares)));
  };
  CHECK(choose_extruder(dialect) == std::vector<std::string>{"T0 P0"});
  CHECK(dialect.define_tool(9, Mixture({1, 0, 0})).empty());
  CHECK(line({2, 1, 1}) == "M567 P0 E.5:.25:.25");
  CHECK(line({1, 1, 1}) == "M567 P0 E.3334:.3333:.3333");
  CHECK(line({0, 0, 5}) == "M567 P0 E0:0:1");
  CHECK(line({1, 2}) == "M567 P0 E.3333:.6667");
  CHECK(line({1, 1, 1, 1, 1, 1, 0, 0}) == "M567 P0 E.1667:.1667:.1667:.1667:.1666:.1666:0:0");
  CHECK_FALSE(dialect.limits().shares_act_at_once);
  CHECK_FALSE(dialect.limits().tool_change_stops);
}

TEST_CASE("quantised shares add up, are off by less than a unit, and do not change when quantised again") {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> shares(0, 1);
  for (int i = 0; i < 5000; ++i) {
    const int decimals = i % 2 == 0 ? 2 : 4;
    const double unit = std::pow(10, -decimals);
    Shares given = Shares::zeros(least_feeders + random() % (most_feeders - 1));
    for (double& share : given) share = random() % 4 ? shares(random) : 0;
    given[0] += 0.01;
    const Mixture mixture(given);
    const Mixture rounded = mixture.quantised(decimals);
    double sum = 0;
    for (std::size_t f = 0; f < mixture.feeders(); ++f) {
      const double units = rounded.share(f) / unit;
      CHECK(std::abs(units - std::round(units)) < 1e-6);
      CHECK(std::abs(rounded.share(f) - mixture.share(f)) < unit);
      sum += std::round(units);
    }
    CHECK(sum == std::round(1 / unit));
    CHECK(rounded.quantised(decimals) == rounded);
  }
}

TEST_CASE("calibration corrects slipping feeders one by one") {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> shares(0.05, 1), factors(0.8, 1.25);
  for (int i = 0; i < 500; ++i) {
    Shares given = Shares::zeros(least_feeders + random() % (most_feeders - 1));
    for (double& share : given) share = shares(random);
    const Mixture wanted(given);
    PerFeeder factor = given;
    for (double& one : factor) one = factors(random);
    const CalibratedMixture tool = calibrated(wanted, factor, dialect_named("marlin"));
    double fed = 0;
    for (std::size_t f = 0; f < wanted.feeders(); ++f) {
      // The firmware turns feeder f by E times its share; of that 1/factor arrives.
      const double arrives = tool.scale * tool.written.share(f) / factor[f];
      CHECK(arrives == Approx(wanted.share(f)).margin(2e-4));
      CHECK(tool.delivered.share(f) == Approx(arrives).margin(1e-12));
      fed += arrives;
    }
    CHECK(fed == Approx(1));
  }
  const CalibratedMixture plain = calibrated(Mixture({2, 1, 1}), {1, 1, 1}, dialect_named("marlin"));
  CHECK(plain.scale == 1);
  CHECK(plain.written == plain.delivered);
}

TEST_CASE("placeholders become numbers of the job") {
  Printer printer;
  printer.nozzle_temperature = 207.5;
  PrintSettings settings;
  settings.layer_count = 42;
  settings.first_layer_height = 0.3;
  settings.temperatures = {{0, 220.0, {}}, {1, 205.0, 50.0}};
  const auto text = [&](const std::string& from) {
    return with_values(from, "gcode.start", printer, settings);
  };
  CHECK(text("M73 P0 ; {comment}\nM117 {layer_count} layers of {layer_height}") ==
        "M73 P0 ; {comment}\nM117 42 layers of .2");
  CHECK(text("M104 S{nozzle_temperature}") == "M104 S220");  // that of the first layer
  CHECK(text("M140 S{bed_temperature}") == "M140 S60");
  CHECK(text("G1 Z{first_layer_height}{bed_x}") == "G1 Z.3200");
  CHECK_THROWS_WITH(text("G1 X{bed_w}"), Catch::Contains("{bed_w}") && Catch::Contains("{bed_x}"));
  CHECK_THROWS_WITH(text("G1 X{bed_x"), Catch::Contains("brace"));
  CHECK_THROWS_WITH(text("G1 X{bed\n_x}"), Catch::Contains("brace"));
  CHECK_THROWS_WITH(text("G1 X}"), Catch::Contains("brace"));
  CHECK(placeholders_in("{a} {bed_x} ; {c}\n{d}") == std::vector<std::string>{"a", "bed_x", "d"});
}
