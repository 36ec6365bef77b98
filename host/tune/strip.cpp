#include "host/tune/strip.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "core/error.hpp"
#include "host/tune/digits.hpp"
#include "host/tune/strip_sizes.hpp"
#include "host/tune/transition_fit.hpp"

namespace unicursal::host {
namespace {

constexpr double usual_range = 60;    ///< mm³; the largest hot ends take 40
constexpr double least_range = 10;    ///< mm³; less is useless
constexpr double range_step = 5;      ///< mm³ by which the range is reduced until the strip fits
constexpr double finest_part = 0.02;  ///< share of the passed volume that a tick is worth at most
constexpr double lead = 10;           ///< mm of the first mixture before the switch
constexpr double pure_length = 50;    ///< mm at the end of a reference line that must be pure
constexpr std::size_t number_step = 10, fifth_step = 5;
/// Ticks at the ends of lanes and turns, modulo 10, so that every number is at least 7 ticks away from the
/// turns.
constexpr std::size_t first_lane_end = 7, lane_end = 4, turn_end = 6;

std::size_t rounded_down(double ticks, std::size_t end) {
  const auto whole = static_cast<std::size_t>(std::max(0.0, ticks));
  return whole < end ? 0 : whole - (whole - end) % number_step;
}

std::size_t rounded_up(double ticks, std::size_t end) {
  auto whole = static_cast<std::size_t>(std::ceil(std::max(0.0, ticks)));
  while (whole % number_step != end) ++whole;
  return whole;
}

/// Lays the strip out from the front of the bed to the back.
class Layout {
 public:
  Layout(const StripSizes& sizes, double range) : s_(sizes), range_(range), here_(s_.left, s_.front) {}

  /// Returns nullopt if the strip does not fit.
  std::optional<Strip> operator()() {
    if (s_.right - s_.left < 80) return std::nullopt;
    strip_.layer_height = s_.layer_height;
    strip_.tick = s_.tick;
    strip_.line_width = s_.line;
    strip_.thin_width = s_.thin / s_.layer_height;
    strip_.fat_width = s_.fat_width;
    const double front_marks = lay_front_row();
    const std::array<std::size_t, 4> percent = {percent_of(perception.began), percent_of(perception.half),
                                                percent_of(perception.stopped), 100};
    for (std::size_t i = 0; i < percent.size(); ++i) {
      fill(static_cast<Shade>(static_cast<std::size_t>(Shade::began) + i), s_.left, s_.right);
      reference(i, percent[i]);
    }
    fill(Shade::from, s_.left, s_.right);
    rise(s_.gap + s_.in_front(), Shade::from);
    if (!lay_strip()) return std::nullopt;
    return surround(front_marks) ? std::optional(std::move(strip_)) : std::nullopt;
  }

 private:
  static std::size_t percent_of(double share) { return static_cast<std::size_t>(std::lround(100 * share)); }

  void go(const core::Vec2& to, double section, Shade shade) {
    strip_.bead.push_back({to, (to - here_).norm() * section, shade});
    here_ = to;
  }
  void rise(double way, Shade shade) { go(here_ + core::Vec2(0, way), s_.fat, shade); }

  /// Lays the lanes that fill the nozzle before the marks, between the front marks. Returns the y of these
  /// marks.
  double lay_front_row() {
    const double radius = s_.mark_radius();
    const double second = s_.left + radius + (s_.right - s_.left - 2 * radius) / 3;
    const double left = second + radius + s_.gap, right = s_.right - 2 * radius - s_.gap;
    here_ = strip_.purge_start = {left, s_.front + s_.fat_width / 2};
    fill(Shade::from, left, right);
    strip_.purge = std::exchange(strip_.bead, {});
    here_ = strip_.start = {s_.left, std::max(here_.y(), s_.front + 2 * radius) + s_.gap};
    return s_.front + radius;
  }

  /// Lays an even number of lanes, no longer than necessary, beginning and ending at the left.
  void fill(Shade shade, double left, double right) {
    const double length = range_ / s_.fat + pure_length;
    const double pairs = std::ceil(length / (2 * (right - left)));
    const double end = left + length / (2 * pairs);
    for (double pair = 0; pair < pairs; ++pair) {
      if (pair > 0) rise(s_.fill_pitch(), shade);
      lay_straight({end, here_.y()}, shade, false);
      rise(s_.fill_pitch(), shade);
      lay_straight({left, here_.y()}, shade, pair + 1 == pairs);
    }
  }

  /// The last lane that fills the nozzle is pure at its end. There the bead becomes as thin as the strip
  /// begins: a thin bead looks a little different from a fat one.
  void lay_straight(const core::Vec2& to, Shade shade, bool last) {
    const core::Vec2 pure = to + core::Vec2(std::min(pure_length, std::abs(to.x() - here_.x()) / 2), 0);
    if (!last) return lay_lane(to, s_.fat, shade, false);
    lay_lane(pure, s_.fat, shade, false);
    lay_lane((pure + to) / 2, s_.fat, shade, true);
    lay_lane(to, s_.thin, shade, true);
  }

  void lay_lane(const core::Vec2& to, double section, Shade shade, bool pure) {
    strip_.straight.push_back({here_, to, section / s_.layer_height, shade, pure});
    go(to, section, shade);
  }

  /// Puts the round marks around everything. Returns false if the bed is too short.
  bool surround(double front) {
    const double radius = s_.mark_radius();
    const double back = here_.y() + s_.behind() + s_.gap + radius;
    if (back + radius > s_.back) return false;
    strip_.round_marks = mark_places({{s_.left + radius, front}, {s_.right - radius, back}});
    std::vector<std::vector<core::Vec2>> all;
    for (const core::Vec2& place : strip_.round_marks) {
      for (auto& stroke : mark_strokes(place, s_.line)) all.push_back(std::move(stroke));
    }
    for (auto& stroke : strip_.marks) all.push_back(std::move(stroke));
    strip_.marks = std::move(all);
    return true;
  }

  /// Marks the lane that ends here as a reference line, and goes to where the next lanes begin.
  void reference(std::size_t which, std::size_t percent) {
    if (which < strip_.references.size()) strip_.references[which] = here_ + core::Vec2(s_.gap, 0);
    write_number(percent, here_ + core::Vec2(s_.gap, s_.gap));
    rise(s_.reference_pitch(), strip_.bead.back().shade);
  }

  void write_number(std::size_t number, const core::Vec2& corner) {
    for (auto& stroke : number_strokes(number, corner, s_)) strip_.marks.push_back(std::move(stroke));
  }

  bool lay_strip() {
    lay_lane(here_ + core::Vec2(lead, 0), s_.thin, Shade::from, true);
    strip_.points.push_back({here_, 0});
    double direction = 1;
    std::size_t ticks = rounded_down((s_.right - here_.x()) / s_.tick, first_lane_end);
    while (!full()) {
      if (ticks < number_step || here_.y() + s_.behind() > s_.back) return false;
      lay_ticks(direction, ticks);
      if (full()) break;
      lay_turn(direction, rounded_up((s_.behind() + s_.in_front()) / s_.tick, turn_end));
      direction = -direction;
      const double room = direction > 0 ? s_.right - here_.x() : here_.x() - s_.left;
      ticks = rounded_down(room / s_.tick + 1e-9, lane_end);
    }
    return here_.y() + s_.behind() <= s_.back;
  }

  bool full() const { return strip_.points.back().passed >= range_; }

  void lay_ticks(double direction, std::size_t ticks) {
    ++strip_.lanes;
    const std::size_t first = strip_.points.size() - 1;
    advance({direction, 0}, ticks);
    mark_lane(first);
  }

  void lay_turn(double outwards, std::size_t ticks) {
    const std::size_t first = strip_.points.size();
    advance({0, 1}, ticks);
    for (std::size_t tick = first; tick + 1 < strip_.points.size(); ++tick) {
      if (tick % 2 == 0) mark(tick, {outwards, 0});
    }
  }

  void advance(const core::Vec2& direction, std::size_t ticks) {
    for (std::size_t i = 0; i < ticks && !full(); ++i) {
      const double passed = strip_.points.back().passed;
      const double section = finest_part * passed < s_.fat * s_.tick ? s_.thin : s_.fat;
      go(here_ + direction * s_.tick, section, Shade::to);
      strip_.points.push_back({here_, passed + section * s_.tick});
    }
  }

  /// Marks the ticks behind the bead on the way out, those in front of it on the way back. There is no room
  /// on the inner side of a turn, which is behind the end of a lane and in front of its beginning.
  void mark_lane(std::size_t first) {
    const std::size_t last = strip_.points.size() - 1;
    const bool turned = first > 0;
    for (std::size_t tick = first; tick <= last; ++tick) {
      if (tick % 2 == 0 && (full() || far(tick, last))) mark(tick, {0, 1});
      if (tick % number_step == 0 && marked(tick)) number(tick);
    }
    for (std::size_t tick = last + 1; tick-- > first;) {
      if (tick % 2 == 1 && (!turned || far(tick, first))) mark(tick, {0, -1});
    }
  }

  bool far(std::size_t tick, std::size_t end) const {
    return (strip_.points[tick].place - strip_.points[end].place).norm() >= s_.gap;
  }
  bool marked(std::size_t tick) const {
    return std::find(strip_.marked.rbegin(), strip_.marked.rend(), tick) != strip_.marked.rend();
  }

  void mark(std::size_t tick, const core::Vec2& away) {
    const core::Vec2 inner = strip_.points[tick].place + away * s_.gap;
    const core::Vec2 outer = inner + away * length_of(tick);
    // Alternating directions, so that the nozzle has the shortest way to the next tick.
    const bool outwards = strip_.marked.size() % 2 == 0;
    strip_.marks.push_back(outwards ? std::vector{inner, outer} : std::vector{outer, inner});
    strip_.marked.push_back(tick);
    strip_.ticks.push_back({inner, outer, s_.line, Shade::from, true});
  }

  double length_of(std::size_t tick) const {
    if (tick % number_step == 0) return s_.tenth_tick;
    return tick % fifth_step == 0 ? s_.fifth_tick : s_.plain_tick;
  }

  void number(std::size_t tick) {
    const double up = s_.gap + s_.tenth_tick + s_.number_gap;
    write_number(tick, strip_.points[tick].place + core::Vec2(-number_width(tick, s_) / 2, up));
  }

  const StripSizes s_;
  const double range_;
  core::Vec2 here_;
  Strip strip_;
};

std::optional<Strip> strip_of(const gcode::Printer& printer, double range) {
  std::optional<Strip> strip = Layout(StripSizes(printer), range)();
  if (strip) std::sort(strip->marked.begin(), strip->marked.end());
  return strip;
}

}  // namespace

Strip::Point Strip::at(double along) const {
  assert(along >= 0);
  const double in_ticks = along / tick;
  const auto before = std::min(static_cast<std::size_t>(in_ticks), points.size() - 2);
  const double part = in_ticks - static_cast<double>(before);
  const Point &a = points[before], &b = points[before + 1];
  return {a.place + part * (b.place - a.place), a.passed + part * (b.passed - a.passed)};
}

Strip make_strip(const gcode::Printer& printer, const std::optional<double>& range) {
  if (range) {
    if (auto strip = strip_of(printer, *range)) return std::move(*strip);
    throw core::DataError("", "--range", fmt::format("a strip for {:g} mm³ does not fit on this bed", *range),
                          "omit the option to get as much as fits");
  }
  for (double smaller = usual_range; smaller >= least_range; smaller -= range_step) {
    if (auto strip = strip_of(printer, smaller)) return std::move(*strip);
  }
  throw core::DataError("", "printer.bed", "is too small for a strip that a transition can be read from",
                        fmt::format("at least 100 x 100 mm are needed for a nozzle of 0.6 mm; this one is "
                                    "{:g} mm",
                                    printer.nozzle));
}

}  // namespace unicursal::host
