// The example jobs through `unicursal plan`: their report and their G-code against figures of the drawings
// that are computed here in another way.
#include <catch2/catch.hpp>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>

#include "core/model/read_part.hpp"
#include "host/job/load_job.hpp"
#include "tests/host/support/child_process.hpp"
#include "tests/host/support/temp_folder.hpp"
#include "tests/paths.hpp"

namespace unicursal {
namespace {

using nlohmann::json;

const std::filesystem::path examples = test::source_folder() / "host/examples";

struct Point {
  double x, y;
};

/// Signed area, mm², between a cubic Bézier curve and the origin: half the integral of x dy − y dx, by
/// Simpson's rule, which is exact for it when each step is small.
double area_below(Point a, Point b, Point c, Point d) {
  const auto integrand = [&](double t) {
    const double s = 1 - t;
    const auto value = [&](double p, double q, double r, double z) {
      return s * s * s * p + 3 * s * s * t * q + 3 * s * t * t * r + t * t * t * z;
    };
    const auto slope = [&](double p, double q, double r, double z) {
      return 3 * (s * s * (q - p) + 2 * s * t * (r - q) + t * t * (z - r));
    };
    return (value(a.x, b.x, c.x, d.x) * slope(a.y, b.y, c.y, d.y) -
            value(a.y, b.y, c.y, d.y) * slope(a.x, b.x, c.x, d.x)) /
           2;
  };
  constexpr int steps = 1000;
  double sum = 0;
  for (int i = 0; i < steps; ++i) {
    const double from = static_cast<double>(i) / steps, width = 1.0 / steps;
    sum += width / 6 * (integrand(from) + 4 * integrand(from + width / 2) + integrand(from + width));
  }
  return sum;
}

/// mm², of the two curves in leaf.svg, without the hole for the ring.
double leaf_area() {
  const double outline =
      area_below({56, 4}, {22, 2}, {2, 14}, {4, 36}) + area_below({4, 36}, {36, 42}, {56, 28}, {56, 4});
  return std::abs(outline) - std::numbers::pi * 2.5 * 2.5;
}

/// What the moves of a G-code file lay in the part: E is mm of filament, relative; a move that lays has x or
/// y.
struct Laid {
  double volume = 0;  ///< mm³
  double length = 0;  ///< mm
};

Laid read_gcode(const std::filesystem::path& file, double filament_diameter) {
  std::istringstream lines(test::read_text(file));
  Laid laid;
  bool in_part = false;
  Point at{0, 0};
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with(";TYPE:")) in_part = line != ";TYPE:Custom" && line != ";TYPE:Skirt";
    if (!line.starts_with("G0 ") && !line.starts_with("G1 ")) continue;
    std::istringstream words(line.substr(3));
    Point to = at;
    double e = 0;
    for (std::string word; words >> word;) {
      const double number = std::stod(word.substr(1));
      if (word[0] == 'X') to.x = number;
      if (word[0] == 'Y') to.y = number;
      if (word[0] == 'E') e = number;
    }
    const double distance = std::hypot(to.x - at.x, to.y - at.y);
    if (in_part && e > 0 && distance > 0) {
      laid.volume += e * std::numbers::pi * filament_diameter * filament_diameter / 4;
      laid.length += distance;
    }
    at = to;
  }
  return laid;
}

struct Planned {
  json report;
  Laid laid;
};

Planned plan(const char* job, const char* layers) {
  const test::TempFolder folder;
  const std::string gcode = (folder / "out.gcode").string(), report = (folder / "out.json").string();
  const test::Outcome outcome =
      test::run({"plan", (examples / job).string(), "--layers", layers, "-o", gcode, "--report", report});
  INFO(outcome.err);
  REQUIRE(outcome.code == 0);
  return {json::parse(test::read_text(report)), read_gcode(gcode, 1.75)};
}

/// The figures that both examples share: beads 0.8 mm apart, layers of 0.2 mm.
void check_figures(const Planned& planned, double area, int layers) {
  const json& totals = planned.report["totals"];
  CHECK(planned.report["layer_count"] == layers);
  CHECK(totals["islands"] == layers);
  CHECK(totals["curves"] == layers);
  CHECK(totals["self_intersections"] == 0);
  CHECK(totals["outside_segments"] == 0);
  CHECK(totals["area_mm2"].get<double>() == Approx(layers * area).epsilon(0.001));
  CHECK(totals["length_mm"].get<double>() == Approx(layers * area / 0.8).epsilon(0.01));
  CHECK(planned.laid.volume == Approx(layers * area * 0.2).epsilon(0.001));
  CHECK(planned.laid.length == Approx(layers * area / 0.8).epsilon(0.02));
  // The shares were asked for as [0.8, 0, 0.2] and so on; what the feeders turn is what is laid and primed.
  const double prime = planned.report["extruded_mm3"].get<double>() - planned.laid.volume;
  CHECK(prime == Approx(2 * 6.1 + 3 * 4).epsilon(0.01));
}

std::size_t layers_of(const char* job) {
  return core::read_part(host::load_job(examples / job).source)->layer_count();
}

}  // namespace

TEST_CASE("leaf.toml: two colours, each crossed once a layer, and the volume of the drawing", "[optimised]") {
  CHECK(layers_of("leaf.toml") == 5);
  const Planned planned = plan("leaf.toml", "0:1");
  check_figures(planned, leaf_area(), 2);
  CHECK(planned.report["warnings"].empty());
  CHECK(planned.report["totals"]["zone_crossings"] == 2 * 2);
  const json& mixing = planned.report["mixing"];
  CHECK(mixing["changes"] >= 2);  // one within each layer, and perhaps one more between the layers
  CHECK(mixing["changes"] <= 4);
  CHECK(mixing["passed_over"] == 0);
  CHECK(mixing["switches"] == mixing["changes"].get<int>() + 1);  // and the first mixture
  CHECK(mixing["wrong_mm3"].get<double>() == Approx(0).margin(0.5));
}

TEST_CASE("cube.toml: the white zone takes up every change between blue and red") {
  CHECK(layers_of("cube.toml") == 100);
  const Planned planned = plan("cube.toml", "0:1");
  check_figures(planned, 20 * 20, 2);
  CHECK(planned.report["totals"]["zone_crossings"] == 2 * 4);
  const json& mixing = planned.report["mixing"];
  // From blue to red and back; a layer that begins and ends in the white zone makes its second change between
  // layers.
  CHECK(mixing["transition_crossings"] >= 2);
  CHECK(mixing["transition_crossings"] <= 2 * 2);
  // A curve may take a short way through the zone, some one time in ten; this is reported.
  const int short_ones = mixing["short_transition_crossings"];
  CHECK(short_ones <= 1);
  CHECK(planned.report["warnings"].size() == static_cast<std::size_t>(short_ones));
  CHECK(mixing["wrong_mm3"].get<double>() == Approx(0).margin(0.1));
  double blue = 0, red = 0;
  for (const json& mixture : planned.report["mixtures"]) {
    if (mixture["name"] == "blue") blue = mixture["part_mm3"];
    if (mixture["name"] == "red") red = mixture["part_mm3"];
  }
  CHECK(blue == Approx(2 * 8 * 20 * 0.2).epsilon(0.02));
  CHECK(red == Approx(2 * 8 * 20 * 0.2).epsilon(0.02));
}

}  // namespace unicursal
