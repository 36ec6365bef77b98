#include "host/tune/strip_photo.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "core/picture/lab.hpp"
#include "host/photo/even_light.hpp"

namespace unicursal::host {
namespace {

using core::Vec2;
using picture::Light;
/// Encoded values of red, green and blue, 0…1: steps of equal size look about equally large.
using Seen = std::array<double, 3>;

constexpr double least_agreement = 0.6;    ///< share of the strokes that must be where they should be
constexpr double along_step = 0.5;         ///< mm between points along the bead
constexpr double pure_step = 4;            ///< mm between samples of a pure line
constexpr double core_part = 0.3;          ///< half of the bead's width that is looked at ÷ its width
constexpr double least_colour_step = 0.1;  ///< between both pure colours, encoded
constexpr double least_difference = 10;    ///< between both pure colours, ΔE2000
constexpr double most_clipped = 0.5;       ///< share of pixels of a pure colour
constexpr double least_reference_step =
    0.015;  ///< between neighbouring reference lines, as a change of colour

Seen encoded(const Light& light) {
  return {picture::encoded(light[0]), picture::encoded(light[1]), picture::encoded(light[2])};
}

double dot(const Seen& a, const Seen& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Seen minus(const Seen& a, const Seen& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

std::size_t material_of(Shade shade) {
  return static_cast<std::size_t>(shade);
}

struct PurePlace {
  Vec2 place{0, 0};
  Light light{};
  Shade shade = Shade::from;
  double clipped = 0;
};

/// Samples the middle of a line every few millimetres.
void add_line(const Sheet& sheet, const Strip::Lane& line, double step, std::vector<PurePlace>& places) {
  const Vec2 way = line.to - line.from;
  const double length = way.norm(), count = std::max(1.0, std::floor(length / step));
  for (double i = 0; i < count; ++i) {
    const Vec2 place = line.from + way * ((i + 0.5) / count);
    const double half = 0.35 * length / count;
    const SeenLight seen = sheet.light(place, way / length, std::min(half, 1.0), core_part * line.width);
    if (seen.pixels > 0) places.push_back({place, seen.light, line.shade, seen.clipped});
  }
}

/// The ring and the disk of a round mark, in four and one places.
void add_round_mark(const Sheet& sheet, const Vec2& centre, double line, std::vector<PurePlace>& places) {
  const MarkSizes sizes(line);
  const double middle = (sizes.ring_inner + sizes.ring_outer) / 2,
               half = (sizes.ring_outer - sizes.ring_inner) / 4;
  for (const Vec2& off : {Vec2(0, 0), Vec2(middle, 0), Vec2(-middle, 0), Vec2(0, middle), Vec2(0, -middle)}) {
    const SeenLight seen = sheet.light(centre + off, {1, 0}, half, half);
    if (seen.pixels > 0) places.push_back({centre + off, seen.light, Shade::from, seen.clipped});
  }
}

EvenLight even_light(const std::vector<PurePlace>& places, const Strip& strip) {
  std::vector<KnownPlace> known;
  for (const PurePlace& one : places) known.push_back({one.place, one.light, material_of(one.shade)});
  return EvenLight(known, {strip.round_marks[0], strip.round_marks[2]});
}

/// The colour of a pure mixture, and how far its samples scatter.
struct PureColour {
  Seen colour{};
  double doubt = 0;  ///< standard deviation of the mean
  double clipped = 0;
};

PureColour pure_colour(const std::vector<PurePlace>& places, const EvenLight& even, Shade shade) {
  std::array<std::vector<double>, 3> channels;
  PureColour pure;
  for (const PurePlace& one : places) {
    if (one.shade != shade) continue;
    const Seen seen = encoded(even.evened(one.place, one.light));
    for (std::size_t c = 0; c < 3; ++c) channels[c].push_back(seen[c]);
    pure.clipped += one.clipped;
  }
  const auto count = static_cast<double>(channels[0].size());
  if (count == 0) return pure;
  for (std::size_t c = 0; c < 3; ++c) {
    pure.colour[c] = median(channels[c]);
    std::vector<double> off;
    for (const double value : channels[c]) off.push_back(std::abs(value - pure.colour[c]));
    // 1.4826 median deviations are a standard deviation; the median of a sample scatters 1.25 times as much
    // as its mean.
    pure.doubt += std::pow(1.4826 * 1.25 * median(off), 2) / count / 3;
  }
  pure.doubt = std::sqrt(pure.doubt);
  pure.clipped /= count;
  return pure;
}

/// The way that the colour takes from one pure mixture to the other.
class ColourWay {
 public:
  ColourWay(const std::vector<PurePlace>& places, const EvenLight& even) {
    for (std::size_t i = 0; i < shade_count; ++i) pure_[i] = pure_colour(places, even, static_cast<Shade>(i));
    way_ = minus(pure_.back().colour, pure_.front().colour);
  }

  const PureColour& pure(Shade shade) const { return pure_[material_of(shade)]; }
  double length() const { return std::sqrt(dot(way_, way_)); }
  /// 0 at the first pure colour, 1 at the second.
  double change(const Seen& seen) const {
    return dot(minus(seen, pure_.front().colour), way_) / dot(way_, way_);
  }
  /// How far a colour lies beside the way, which leads over the reference lines.
  double beside(const Seen& seen) const {
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i + 1 < shade_count; ++i) {
      const Seen step = minus(pure_[i + 1].colour, pure_[i].colour), off = minus(seen, pure_[i].colour);
      const double squared = dot(step, step);
      const double part = squared > 0 ? std::clamp(dot(off, step) / squared, 0.0, 1.0) : 0.0;
      const Seen rest = minus(off, {part * step[0], part * step[1], part * step[2]});
      nearest = std::min(nearest, dot(rest, rest));
    }
    return std::sqrt(nearest);
  }

 private:
  std::array<PureColour, shade_count> pure_;
  Seen way_{};
};

void check_colours(const ColourWay& way, const std::filesystem::path& file) {
  for (const Shade shade : {Shade::from, Shade::to}) {
    if (way.pure(shade).clipped <= most_clipped) continue;
    throw core::DataError(file.string(), "",
                          "is too bright: a pure colour is as light as the camera can show",
                          "take it again with less light, or with a darker exposure");
  }
  const auto lab = [&](Shade shade) {
    const Seen& seen = way.pure(shade).colour;
    return picture::lab_of(
        Light{picture::decoded(seen[0]), picture::decoded(seen[1]), picture::decoded(seen[2])});
  };
  const double difference = picture::difference(lab(Shade::from), lab(Shade::to));
  if (difference >= least_difference && way.length() >= least_colour_step) return;
  throw core::DataError(
      file.string(), "",
      fmt::format("shows two colours that are too alike to read a change from (ΔE2000 is {:.1f})",
                  difference),
      "print the strip with two strong colours, for example --from 1 --to 3, or take the photo in more "
      "light");
}

CurveAnchors anchors_of(const ColourWay& way, const std::filesystem::path& file) {
  CurveAnchors anchors;
  const Shade shades[] = {Shade::began, Shade::half, Shade::stopped};
  const double ends = std::hypot(way.pure(Shade::from).doubt, way.pure(Shade::to).doubt);
  double before = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const PureColour& pure = way.pure(shades[i]);
    anchors.change[i] = way.change(pure.colour);
    anchors.doubt[i] = std::hypot(pure.doubt, ends) / way.length();
    if (anchors.change[i] < before + least_reference_step)
      throw core::DataError(
          file.string(), "", "does not show the reference lines in three different colours",
          "take it again in even light and without glare, or print the strip with two strong "
          "colours");
    before = anchors.change[i];
  }
  if (before > 1 - least_reference_step)
    throw core::DataError(
        file.string(), "", "does not show line 95 in another colour than line 100",
        "print the strip with --from and --to exchanged: a trace of a dark colour shows in a "
        "light one");
  return anchors;
}

}  // namespace

SheetPlan sheet_plan(const Strip& strip) {
  SheetPlan plan;
  plan.marks = strip.round_marks;
  plan.line = strip.line_width;
  // Lanes that fill the nozzle lie one line apart, ticks of one side two ticks.
  for (const Strip::Lane& lane : strip.straight)
    plan.strokes.push_back({lane.from, lane.to, lane.width, strip.line_width});
  for (const Strip::Lane& tick : strip.ticks)
    plan.strokes.push_back({tick.from, tick.to, tick.width, (2 * strip.tick - tick.width) / 2});
  constexpr std::size_t ticks_together = 4;
  for (std::size_t i = 0; i + ticks_together < strip.points.size(); i += ticks_together) {
    const Strip::Point &a = strip.points[i], &b = strip.points[i + ticks_together];
    const double length = (b.place - a.place).norm();
    if (length < 0.99 * strip.tick * static_cast<double>(ticks_together)) continue;  // a corner lies between
    plan.strokes.push_back(
        {a.place, b.place, (b.passed - a.passed) / length / strip.layer_height, strip.line_width});
  }
  return plan;
}

StripCurve read_curve(const Sheet& sheet, const Strip& strip, const std::filesystem::path& file) {
  if (sheet.agreement() < least_agreement)
    throw core::DataError(
        file.string(), "",
        fmt::format(
            "shows another print than this profile's strip: only {:.0f} % of its lines are where they "
            "should be",
            100 * sheet.agreement()),
        "use the profile and the --range with which the strip was printed, and a sharp photo");
  std::vector<PurePlace> places;
  for (const Strip::Lane& lane : strip.straight) {
    if (lane.pure) add_line(sheet, lane, pure_step, places);
  }
  const std::size_t of_lines = places.size();
  for (const Strip::Lane& tick : strip.ticks) add_line(sheet, tick, tick.width + 100, places);
  for (const Vec2& centre : strip.round_marks) add_round_mark(sheet, centre, strip.line_width, places);
  const EvenLight even = even_light(places, strip);
  places.resize(of_lines);  // narrow lines and wide marks may look a little different
  const ColourWay way(places, even);
  check_colours(way, file);
  StripCurve curve;
  curve.anchors = anchors_of(way, file);
  std::vector<double> besides;
  for (double along = along_step / 2; along < strip.length(); along += along_step) {
    const Strip::Point here = strip.at(along), before = strip.at(along - along_step / 2),
                       after = strip.at(std::min(strip.length(), along + along_step / 2));
    const Vec2 step = after.place - before.place;
    const double width = (after.passed - before.passed) / along_step / strip.layer_height;
    const SeenLight seen = sheet.light(here.place, step.normalized(), along_step / 2, core_part * width);
    CurvePoint point{here.passed, 0, 0};
    double beside = 1;
    if (seen.pixels > 0) {
      const Seen colour = encoded(even.evened(here.place, seen.light));
      point.change = way.change(colour);
      point.trust = 1;
      beside = way.beside(colour);
      if (seen.clipped > most_clipped) point.trust = 0;
    }
    curve.points.push_back(point);
    besides.push_back(beside);
  }
  const double usual = median(besides);
  for (std::size_t i = 0; i < besides.size(); ++i) {
    if (besides[i] > 4 * usual + 0.06) curve.points[i].trust = 0;
  }
  const auto lost = std::count_if(curve.points.begin(), curve.points.end(),
                                  [](const CurvePoint& point) { return point.trust == 0; });
  if (2 * lost > static_cast<std::ptrdiff_t>(curve.points.size()))
    throw core::DataError(file.string(), "",
                          "hides more than half of the bead behind glare or outside the photo",
                          "take it again in soft light, with the whole strip in it");
  return curve;
}

}  // namespace unicursal::host
