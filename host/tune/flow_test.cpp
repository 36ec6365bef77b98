#include "host/tune/flow_test.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <regex>
#include <sstream>

#include "core/error.hpp"
#include "firmware_gcode/dialect/dialect_named.hpp"
#include "firmware_gcode/print/bounds.hpp"
#include "host/tune/digits.hpp"
#include "host/tune/strip_sizes.hpp"

namespace unicursal::host {
namespace {

constexpr double band_filament = 100;  ///< mm of filament in a band
constexpr double band_flow = 3;        ///< mm³/s
constexpr double between_bands = 4;    ///< mm

double filament_area(const gcode::Printer& printer) {
  return std::numbers::pi / 4 * printer.filament_diameter * printer.filament_diameter;
}

/// Lanes that go to and fro, each as long as the others.
class BandLayout {
 public:
  BandLayout(const gcode::Printer& printer, const StripSizes& sizes)
      : s_(sizes),
        volume_(band_filament * filament_area(printer)),
        left_(s_.left + number_width(most_number, s_) + 2 * s_.line + s_.fat_width / 2) {
    const double room = s_.right - left_;
    if (room > 0) lanes_ = std::ceil(volume_ / (s_.fat * room));
  }

  bool fits(std::size_t bands) const {
    return lanes_ > 0 && s_.front + static_cast<double>(bands) * pitch() - between_bands <= s_.back;
  }

  TestBead band(std::size_t which, std::size_t mixture) const {
    TestBead bead{{left_, front_of(which)}, {}};
    const double length = lanes_ * (s_.right - left_) + (lanes_ - 1) * s_.fill_pitch();
    core::Vec2 here = bead.start;
    const auto go = [&](const core::Vec2& to) {
      bead.moves.push_back({to, volume_ * (to - here).norm() / length, mixture});
      here = to;
    };
    for (double lane = 0; lane < lanes_; ++lane) {
      if (lane > 0) go(here + core::Vec2(0, s_.fill_pitch()));
      go({here.x() > left_ ? left_ : s_.right, here.y()});
    }
    return bead;
  }

  std::vector<std::vector<core::Vec2>> number(std::size_t which) const {
    return number_strokes(which + 1, {s_.left, front_of(which)}, s_);
  }

 private:
  static constexpr std::size_t most_number = gcode::most_feeders;

  double pitch() const {
    return std::max((lanes_ - 1) * s_.fill_pitch() + s_.fat_width, s_.digit_height) + between_bands;
  }
  double front_of(std::size_t which) const { return s_.front + static_cast<double>(which) * pitch(); }

  const StripSizes& s_;
  const double volume_, left_;
  double lanes_ = 0;  ///< a whole number
};

gcode::PerFeeder asked_by(const TestPrint& print, const gcode::Printer& printer) {
  gcode::PerFeeder asked = gcode::PerFeeder::zeros(printer.feeders);
  const auto add = [&](double volume, std::size_t mixture) {
    for (std::size_t f = 0; f < asked.size(); ++f)
      asked[f] += volume * print.mixtures[mixture].share(f) / filament_area(printer);
  };
  for (const TestLayer& layer : print.layers) {
    for (const auto& line : layer.marks) {
      for (std::size_t i = 1; i < line.size(); ++i)
        add((line[i] - line[i - 1]).norm() * print.line_width * print.layer_height, print.marks_mixture);
    }
    for (const TestBead& bead : layer.beads) {
      for (const TestMove& move : bead.moves) add(move.volume, move.mixture);
    }
  }
  return asked;
}

}  // namespace

FlowTest make_flow_test(const gcode::Printer& printer) {
  FlowTest test{printer, false, {}, {}};
  test.printer.flow_factors = gcode::PerFeeder::all(printer.feeders, 1);
  test.printer.start_gcode = without_feeding(printer.start_gcode);
  test.printer.end_gcode = without_feeding(printer.end_gcode);
  test.scripts_shortened =
      test.printer.start_gcode != printer.start_gcode || test.printer.end_gcode != printer.end_gcode;
  const StripSizes sizes(printer);
  const BandLayout layout(printer, sizes);
  if (!layout.fits(printer.feeders))
    throw core::DataError("", "printer.bed", "is too small for lines of 100 mm of each filament",
                          "measure the flow factors by hand, see extruder.flow_factors in "
                          "unicursal-profile(5)");
  TestPrint& print = test.print;
  print.title = "lines of each feeder, to measure how far its filament goes";
  print.name = "the lines";
  print.layer_height = sizes.layer_height;
  print.line_width = sizes.line;
  print.flow = band_flow;
  print.layers.emplace_back();
  const gcode::Dialect& dialect = gcode::dialect_named(printer.firmware);
  for (std::size_t f = 0; f < printer.feeders; ++f) {
    print.mixtures.push_back(dialect.as_written(feeder_alone(f, printer)));
    for (auto& stroke : layout.number(f)) print.layers.front().marks.push_back(std::move(stroke));
    print.layers.front().beads.push_back(layout.band(f, f));
  }
  test.asked = asked_by(print, printer);
  return test;
}

gcode::PerFeeder flow_factors(const gcode::PerFeeder& asked, const gcode::PerFeeder& went_in) {
  gcode::PerFeeder factors = asked;
  for (std::size_t f = 0; f < factors.size(); ++f) {
    factors[f] = asked[f] / went_in[f];
    if (gcode::bounds::flow_factor.hold(factors[f])) continue;
    throw core::DataError(
        "", fmt::format("feeder {}", f + 1),
        fmt::format("took {:.1f} mm of filament instead of {:.1f} mm", went_in[f], asked[f]),
        "measure again; if it is right, correct the steps per mm of the firmware, or "
        "extruder.steps_per_mm, and print again");
  }
  return factors;
}

std::string without_feeding(const std::string& script) {
  static const std::regex feeding(R"(^\s*(N\d+\s*)?G0*[0-3](?![0-9])[^;(]*E\s*[-+.0-9{].*)",
                                  std::regex::icase);
  std::istringstream lines(script);
  std::string kept;
  for (std::string line; std::getline(lines, line);) {
    // Scripts are the user's; a very long line is not a move.
    constexpr std::size_t longest = 200;
    if (line.size() <= longest && std::regex_match(line, feeding)) continue;
    kept += line + "\n";
  }
  if (!script.empty() && script.back() != '\n' && !kept.empty()) kept.pop_back();
  return kept;
}

}  // namespace unicursal::host
