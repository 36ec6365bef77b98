#include "firmware_gcode/interruption/aside.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <numeric>
#include <string_view>

#include "firmware_gcode/dialect/dialect_named.hpp"
#include "firmware_gcode/dialect/number.hpp"
#include "firmware_gcode/dialect/share_writing.hpp"
#include "firmware_gcode/mixing/calibration.hpp"

namespace unicursal::gcode {
namespace {

constexpr double rise = 10;           ///< mm; parts curl up less than this
constexpr double part_clearance = 5;  ///< mm between the part and the squeezed-out plastic
constexpr double edge_inset = 5;      ///< mm from the bed's edge

std::string position(double value) {
  return short_number(value, 3);
}

constexpr double rounding = 0.01;  ///< of equal shares that are written with two decimals

/// The share in "M163 S0 P.3333"; 0 in any other line.
double share_in(const std::string& line) {
  const auto at = line.find(" P");
  return line.starts_with("M163 ") && at != std::string::npos ? std::strtod(line.c_str() + at + 2, nullptr)
                                                              : 0;
}

/// Returns whether the lines define a tool that feeds equal shares; dialects scale shares differently.
bool feeds_equal_shares(const ModalState::Lines& definition, const Printer& printer) {
  if (definition.size() != printer.feeders + 1) return false;
  Shares fed = Shares::zeros(printer.feeders);
  for (std::size_t f = 0; f < fed.size(); ++f) fed[f] = share_in(definition[f]) / printer.flow_factors[f];
  const double sum = std::accumulate(fed.begin(), fed.end(), 0.0);
  return sum > 0 && std::all_of(fed.begin(), fed.end(), [&](double share) {
           return std::abs(share / sum - 1.0 / static_cast<double>(printer.feeders)) < rounding;
         });
}

std::string selecting(int tool) {
  return fmt::format("T{}", tool);
}

/// The line that selects equal shares, which draw filament back from all inlets alike; nullopt if the print
/// has no virtual tool for them.
std::optional<std::string> line_of_equal_shares(const ModalState& state, const Printer& printer) {
  const Dialect& dialect = dialect_named(printer.firmware);
  if (const ShareWriting* writing = share_writing(dialect))
    return writing->write_shares(
        calibrated(Mixture::equal(printer.feeders), printer.flow_factors, dialect).written);
  for (const auto& [tool, definition] : state.tools) {
    if (feeds_equal_shares(definition, printer)) return selecting(tool);
  }
  return std::nullopt;
}

}  // namespace

std::optional<core::Vec2> place_beside(const Printer& printer, const core::Box& extent) {
  const double x = printer.bed[0] - edge_inset, y = printer.bed[1] - edge_inset;
  const std::array<core::Vec2, 4> corners{core::Vec2(edge_inset, edge_inset), core::Vec2(x, edge_inset),
                                          core::Vec2(edge_inset, y), core::Vec2(x, y)};
  const auto distance = [&](const core::Vec2& p) {
    const core::Vec2 nearest = p.cwiseMax(extent.min).cwiseMin(extent.max);
    return (p - nearest).norm();
  };
  const auto best = std::max_element(corners.begin(), corners.end(),
                                     [&](const auto& a, const auto& b) { return distance(a) < distance(b); });
  return distance(*best) >= part_clearance ? std::optional(*best) : std::nullopt;
}

double height_aside(const Printer& printer, double height, const ModalState& state) {
  const double top = std::max(height, state.laid_top);
  return top + std::clamp(printer.bed[2] - top, 0.0, rise);
}

AsideWriter::AsideWriter(const Printer& printer, const ModalState& state, double drawn)
    : printer_(printer), state_(state), equal_shares_(line_of_equal_shares(state, printer)), drawn_(drawn) {}

void AsideWriter::lines(const std::vector<std::string>& more) {
  chunk_.lines.insert(chunk_.lines.end(), more.begin(), more.end());
}

void AsideWriter::choose_extruder() {
  lines(gcode::choose_extruder(dialect_named(printer_.firmware)));
}

void AsideWriter::select_mixture() {
  if (!state_.tool || *state_.tool < 0) return;
  if (!share_writing(dialect_named(printer_.firmware))) return line("{}", selecting(*state_.tool));
  const auto shares = state_.tools.find(*state_.tool);
  if (shares != state_.tools.end()) lines(shares->second);
}

void AsideWriter::heat() {
  const std::string bed = short_number(state_.bed, 1), nozzle = short_number(state_.nozzle, 1);
  lines({"M140 S" + bed, "M104 S" + nozzle, "M190 S" + bed, "M109 S" + nozzle});
}

void AsideWriter::travel(const core::Vec2& to) {
  const double speed = std::min(printer_.max_speed[0], printer_.max_speed[1]);
  line("G0 X{} Y{} F{}", position(to.x()), position(to.y()), short_number(60 * speed, 0));
}

void AsideWriter::height(double z) {
  line("G1 Z{} F{}", position(z), short_number(60 * printer_.max_speed[2], 0));
}

void AsideWriter::draw_back() {
  const double missing = printer_.retraction_length - drawn_;
  if (missing <= 0) return;
  draw(-missing);
  drawn_ = printer_.retraction_length;
}

void AsideWriter::squeeze(double volume, double flow) {
  draw(drawn_);
  select_mixture();
  filament(volume / filament_area(), flow / filament_area());
  chunk_.volume += volume;
  chunk_.prime_volume += volume;
  drawn_ = 0;
}

void AsideWriter::approach() {
  travel({*state_.position[0], *state_.position[1]});
  height(*state_.position[2]);
  draw(drawn_ - state_.drawn_back);
  drawn_ = state_.drawn_back;
  select_mixture();  // draw() may have selected another one
  if (state_.fan > 0) line("M106 S{}", short_number(state_.fan, 0));
  if (state_.feed) line("G1 F{}", short_number(*state_.feed, 0));
}

void AsideWriter::draw(double length) {
  if (length == 0) return;
  if (equal_shares_) line("{}", *equal_shares_);
  filament(length, printer_.retraction_speed);
}

void AsideWriter::filament(double length, double speed) {
  constexpr double longest = 50;  // mm in one move; firmwares refuse more
  const double pieces = std::max(1.0, std::ceil(std::abs(length) / longest));
  if (scaled(length / pieces, 5) == 0) return;
  for (double piece = 0; piece < pieces; ++piece) {
    line("G1 E{} F{}", short_number(length / pieces, 5), short_number(std::max(60 * speed, 1.0), 0));
  }
}

double AsideWriter::filament_area() const {
  return std::numbers::pi / 4 * printer_.filament_diameter * printer_.filament_diameter;
}

}  // namespace unicursal::gcode
