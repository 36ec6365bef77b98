#include "firmware_gcode/interruption/fed_filament.hpp"

#include <catch2/catch.hpp>
#include <string>
#include <vector>

namespace unicursal::gcode {
namespace {

PerFeeder turned(std::size_t feeders, const std::vector<std::string>& lines) {
  FedFilament fed(feeders);
  for (const std::string& line : lines) fed.run(line);
  return fed.turned();
}

}  // namespace

TEST_CASE("filament is counted for each feeder as every firmware feeds it") {
  const std::vector<std::string> begin{"G21", "G90", "M83"};
  const auto with = [&](std::vector<std::string> lines) {
    lines.insert(lines.begin(), begin.begin(), begin.end());
    return lines;
  };
  // Marlin, with two tools and a retraction in the second mixture.
  const PerFeeder marlin =
      turned(2, with({"M163 S0 P.25", "M163 S1 P.75", "M164 S0", "M163 S0 P1", "M163 S1 P0", "M164 S1", "T0",
                      "G1 X10 E8 F1200", "T1", "G1 E-4 F1500 ; back"}));
  CHECK(marlin[0] == Approx(8 * 0.25 - 4));
  CHECK(marlin[1] == Approx(6));
  const PerFeeder repetier = turned(
      4, with({"M400", "M163 S0 P50", "M163 S1 P0", "M163 S2 P0", "M163 S3 P50", "M164 S3", "T3", "G1 E10"}));
  CHECK(repetier[0] == Approx(5));
  CHECK(repetier[1] == 0);
  CHECK(repetier[3] == Approx(5));
  const PerFeeder duet =
      turned(3, with({"T0 P0", "M567 P0 E.2:.3:.5", "G1 X1 E10", "M567 P0 E1:0:0", "G1 X2 E1"}));
  CHECK(duet[0] == Approx(3));
  CHECK(duet[1] == Approx(3));
  CHECK(duet[2] == Approx(5));
}

TEST_CASE("absolute filament, G92 and damaged lines are counted as a firmware takes them") {
  const PerFeeder fed =
      turned(2, {"M82", "M163 S0 P1", "M163 S1 P0", "M164 S0", "T0", "G92 E0", "G1 X1 E5", "G1 X2 E8",
                 "G92 E0", "G1 E2", "T9", "M164 S9999", "M163 S7 P1", ";G1 E90", ""});
  CHECK(fed[0] == Approx(10));
  CHECK(fed[1] == 0);
}

}  // namespace unicursal::gcode
