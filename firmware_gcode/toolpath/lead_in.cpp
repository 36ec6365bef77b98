#include "firmware_gcode/toolpath/lead_in.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>
#include <optional>
#include <string_view>
#include <utility>

#include "firmware_gcode/dialect/number.hpp"
#include "firmware_gcode/toolpath/job_frame.hpp"

namespace unicursal::gcode {
namespace {

constexpr double rise = 10;           ///< mm; more than any part curls up
constexpr double part_clearance = 5;  ///< mm between the part and what is squeezed out beside it
constexpr double edge_inset = 5;      ///< mm from the bed's edge
constexpr double transitions = 2;     ///< of plastic squeezed out: as the prime line at a print's beginning

std::string position(double value) {
  return short_number(value, 3);
}

/// The corner of the bed that is farthest from the part, if that is far enough.
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

/// M163 S0 P.3333: what stands behind the P.
std::string_view share_in(std::string_view line) {
  const auto at = line.find(" P");
  return line.starts_with("M163 ") && at != std::string_view::npos ? line.substr(at) : std::string_view();
}

std::optional<int> tool_of_equal_shares(const ModalState& state) {
  for (const auto& [tool, lines] : state.tools) {
    const std::string_view first = share_in(lines.front());
    const bool equal = std::all_of(lines.begin(), lines.end() - 1,
                                   [&](const std::string& line) { return share_in(line) == first; });
    if (lines.size() > 2 && !first.empty() && equal) return tool;
  }
  return std::nullopt;
}

class Writer {
 public:
  Writer(const Printer& printer, const LeadIn& to) : printer_(printer), to_(to), state_(to.state) {}

  Chunk operator()() {
    heat();
    find_position();
    mixtures();
    squeeze_out();
    approach();
    return std::move(chunk_);
  }

 private:
  template <class... Arguments>
  void line(fmt::format_string<Arguments...> text, Arguments&&... arguments) {
    chunk_.lines.push_back(fmt::format(text, std::forward<Arguments>(arguments)...));
  }
  void lines(const std::vector<std::string>& more) {
    chunk_.lines.insert(chunk_.lines.end(), more.begin(), more.end());
  }

  void heat() {
    lines({after_user_start().front(), "M220 S" + short_number(state_.speed_factor, 1),
           "M221 S" + short_number(state_.flow_factor, 1)});
    const std::string bed = short_number(state_.bed, 1), nozzle = short_number(state_.nozzle, 1);
    lines({"M140 S" + bed, "M104 S" + nozzle, "M190 S" + bed, "M109 S" + nozzle});
  }

  void find_position() {
    const double up = lead_in_rise(printer_, to_.height);
    lines({"G21", "G91", "G1 Z" + position(up) + " F" + z_feed(), "G90"});
    lines({"G92 Z" + position(to_.height + up), "G28 X Y"});
    lines(modes());
  }

  void mixtures() {
    for (const auto& [tool, definition] : state_.tools) lines(definition);
    select(state_.tool);
  }

  /// The filament hangs back by what the print had drawn back, or, after a loss of power, by what has oozed.
  void squeeze_out() {
    const auto place = place_beside(printer_, to_.extent);
    if (!place) {
      chunk_.warnings.push_back(
          "the part leaves no place on the bed beside it, so nothing is squeezed out before the print goes "
          "on; the first beads may come out thin or in a former colour");
      return;
    }
    travel(*place);
    filament(state_.drawn_back, printer_.retraction_speed);
    const double volume = transitions * (printer_.dead_volume + printer_.mixing_volume);
    filament(volume / filament_area(), to_.flow / filament_area());
    chunk_.volume += volume;
    chunk_.prime_volume += volume;
    draw(-printer_.retraction_length);
    drawn_ = printer_.retraction_length;
  }

  void approach() {
    travel({*state_.position[0], *state_.position[1]});
    line("G1 Z{} F{}", position(*state_.position[2]), z_feed());
    draw(drawn_ - state_.drawn_back);
    select(state_.tool);  // draw() may have changed it
    if (state_.fan > 0) line("M106 S{}", short_number(state_.fan, 0));
    if (state_.feed) line("G1 F{}", short_number(*state_.feed, 0));
  }

  void select(std::optional<int> tool) {
    if (tool && *tool >= 0) line("T{}", *tool);
  }

  void travel(const core::Vec2& to) {
    const double speed = std::min(printer_.max_speed[0], printer_.max_speed[1]);
    line("G0 X{} Y{} F{}", position(to.x()), position(to.y()), short_number(60 * speed, 0));
  }

  void draw(double length) {
    if (length == 0) return;
    select(tool_of_equal_shares(state_));
    filament(length, printer_.retraction_speed);
  }

  void filament(double length, double speed) {
    constexpr double longest = 50;  // mm at once; firmwares refuse too much
    const double pieces = std::max(1.0, std::ceil(std::abs(length) / longest));
    if (scaled(length / pieces, 5) == 0) return;
    for (double piece = 0; piece < pieces; ++piece) {
      line("G1 E{} F{}", short_number(length / pieces, 5), short_number(std::max(60 * speed, 1.0), 0));
    }
  }

  std::string z_feed() const { return short_number(60 * printer_.max_speed[2], 0); }
  double filament_area() const {
    return std::numbers::pi / 4 * printer_.filament_diameter * printer_.filament_diameter;
  }

  const Printer& printer_;
  const LeadIn& to_;
  const ModalState& state_;
  Chunk chunk_;
  double drawn_ = to_.state.drawn_back;  ///< mm
};

}  // namespace

double lead_in_rise(const Printer& printer, double height) {
  return std::clamp(printer.bed[2] - height, 0.0, rise);
}

Chunk lead_in(const Printer& printer, const LeadIn& to) {
  assert(to.state.position[0] && to.state.position[1] && to.state.position[2] && !to.state.relative);
  return Writer(printer, to)();
}

}  // namespace unicursal::gcode
