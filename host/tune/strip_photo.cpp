#include "host/tune/strip_photo.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/picture/lab.hpp"
#include "host/photo/even_light.hpp"

namespace unicursal::host {
namespace {

using core::Vec2;
using picture::Light;

constexpr double least_agreement = 0.6;    ///< share of the strokes that must be where they should be
constexpr double along_step = 0.5;         ///< mm between points along the strip
constexpr double fill_step = 1;            ///< mm between points along the lanes that fill the nozzle
constexpr double most_half = 0.95;         ///< change of colour at line 50, or 1 minus it
constexpr double pure_step = 4;            ///< mm between samples of a pure line
constexpr double core_part = 0.3;          ///< half of the bead's width that is looked at ÷ its width
constexpr double least_colour_step = 0.1;  ///< between both pure colours, encoded
constexpr double least_difference = 10;    ///< between both pure colours, ΔE2000
constexpr double clipped_at_most = 0.5;    ///< share of pixels of a pure colour

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

/// Lines of one shade and width look alike in the same light; ticks and round marks run in other directions
/// and are lit differently.
std::size_t material_of(Shade shade, bool fat) {
  return 2 * static_cast<std::size_t>(shade) + (fat ? 1 : 0);
}
constexpr std::size_t tick_material = 2 * shade_count, mark_material = tick_material + 1,
                      purge_material = mark_material + 1;

struct PurePlace {
  Vec2 place{0, 0};
  Light light{};
  std::size_t material = 0;
  double clipped = 0;
};

/// Samples the middle of a line every few millimetres.
void add_line(const Sheet& sheet, const Strip::Lane& line, std::size_t material, double step,
              std::vector<PurePlace>& places) {
  const Vec2 way = line.to - line.from;
  const double length = way.norm(), count = std::max(1.0, std::floor(length / step));
  for (double i = 0; i < count; ++i) {
    const Vec2 place = line.from + way * ((i + 0.5) / count);
    const double half = 0.35 * length / count;
    const SeenLight seen = sheet.light(place, way / length, std::min(half, 1.0), core_part * line.width);
    if (seen.pixels > 0) places.push_back({place, seen.light, material, seen.clipped});
  }
}

/// The ring and the disk of a round mark, in four and one places.
void add_round_mark(const Sheet& sheet, const Vec2& centre, double line, std::vector<PurePlace>& places) {
  const MarkSizes sizes(line);
  const double middle = (sizes.ring_inner + sizes.ring_outer) / 2,
               half = (sizes.ring_outer - sizes.ring_inner) / 4;
  for (const Vec2& off : {Vec2(0, 0), Vec2(middle, 0), Vec2(-middle, 0), Vec2(0, middle), Vec2(0, -middle)}) {
    const SeenLight seen = sheet.light(centre + off, {1, 0}, half, half);
    if (seen.pixels > 0) places.push_back({centre + off, seen.light, mark_material, seen.clipped});
  }
}

EvenLight even_light(const std::vector<PurePlace>& places, const Strip& strip) {
  std::vector<KnownPlace> known;
  for (const PurePlace& one : places) known.push_back({one.place, one.light, one.material});
  return EvenLight(known, {strip.round_marks[0], strip.round_marks[2]});
}

/// The colour of a pure mixture, and how far its samples scatter.
struct PureColour {
  Seen colour{};
  double doubt = 0;  ///< standard deviation of the mean
  double clipped = 0;
  std::size_t places = 0;  ///< of the photo at which it was seen
};

PureColour pure_colour(const std::vector<PurePlace>& places, const EvenLight& even, std::size_t material) {
  std::array<std::vector<double>, 3> channels;
  PureColour pure;
  for (const PurePlace& one : places) {
    if (one.material != material) continue;
    const Seen seen = encoded(even.evened(one.place, one.light));
    for (std::size_t c = 0; c < 3; ++c) channels[c].push_back(seen[c]);
    pure.clipped += one.clipped;
  }
  pure.places = channels[0].size();
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

/// The lines of one width.
class ReferenceLines {
 public:
  ReferenceLines(const std::vector<PurePlace>& places, const EvenLight& even, bool fat) {
    for (std::size_t i = 0; i < shade_count; ++i)
      pure_[i] = pure_colour(places, even, material_of(static_cast<Shade>(i), fat));
  }

  const PureColour& pure(Shade shade) const { return pure_[static_cast<std::size_t>(shade)]; }
  ReferenceColours::Lines colours() const {
    ReferenceColours::Lines lines;
    for (std::size_t i = 0; i < shade_count; ++i) {
      lines.colour[i] = pure_[i].colour;
      lines.doubt[i] = pure_[i].doubt;
    }
    return lines;
  }

 private:
  std::array<PureColour, shade_count> pure_;
};

void check_all_seen(const ReferenceLines& lines, const std::filesystem::path& file) {
  for (std::size_t i = 0; i < shade_count; ++i) {
    if (lines.pure(static_cast<Shade>(i)).places > 0) continue;
    throw core::DataError(file.string(), "", "does not show all reference lines",
                          "take it again with the whole strip in it");
  }
}

void check_brightness(const ReferenceLines& lines, const std::filesystem::path& file) {
  if (std::max(lines.pure(Shade::from).clipped, lines.pure(Shade::to).clipped) <= clipped_at_most) return;
  throw core::DataError(file.string(), "", "is too bright: a pure colour is as light as the camera can show",
                        "take it again with less light, or with a darker exposure");
}

/// ΔE2000 between both pure colours, or less if the channels differ too little to be measured.
double contrast(const ReferenceLines& lines) {
  const Seen &from = lines.pure(Shade::from).colour, &to = lines.pure(Shade::to).colour;
  const auto lab = [](const Seen& seen) {
    return picture::lab_of(
        Light{picture::decoded(seen[0]), picture::decoded(seen[1]), picture::decoded(seen[2])});
  };
  const Seen way = minus(to, from);
  const double step = std::sqrt(dot(way, way)) / least_colour_step;
  return std::min(picture::difference(lab(from), lab(to)), step * least_difference);
}

void check_contrast(const ReferenceLines& thin, const ReferenceLines& fat,
                    const std::filesystem::path& file) {
  const double of_thin = contrast(thin), of_fat = contrast(fat);
  if (std::min(of_thin, of_fat) >= least_difference) return;
  // Filaments that are alike are so in lines of both widths.
  if (std::max(of_thin, of_fat) >= 2 * least_difference)
    throw core::DataError(file.string(), "", "hides a reference line, as a reflection does",
                          "take it again from another side, without reflections on the lines");
  throw core::DataError(
      file.string(), "",
      fmt::format("shows two colours that are too alike to read a change from (ΔE2000 is {:.1f})",
                  std::min(of_thin, of_fat)),
      "print the strip with two strong colours, for example --from 1 --to 3, or take the photo in more "
      "light");
}

/// The lines of 5, 50 and 95 % lie in this order between the pure colours.
void check_order(const ReferenceColours& references, const std::filesystem::path& file) {
  const ColourAnswer answer(references);
  for (const double fat : {0.0, 1.0}) {
    const ReferenceColours::Lines& lines = fat > 0 ? references.fat : references.thin;
    std::array<double, 3> change{};
    for (std::size_t i = 0; i < 3; ++i) change[i] = answer.change(lines.colour[i + 1], fat);
    if (change[1] > most_half || change[1] < 1 - most_half)
      throw core::DataError(
          file.string(), "",
          fmt::format("shows line 50 in nearly the colour of line {}", change[1] > 0.5 ? 100 : 0),
          "print the strip with two colours of about equal strength, or with --from and --to "
          "exchanged");
    if (change[0] >= change[1] || change[1] >= change[2])
      throw core::DataError(
          file.string(), "", "does not show the reference lines in the order of their colours",
          "take it again in even light and without glare, or print the strip with two strong "
          "colours");
  }
}

/// The bead in short pieces, from its beginning to its end, without those that run across the lanes: they are
/// lit from another side.
class Bead {
 public:
  struct Piece {
    Vec2 place{0, 0}, direction{1, 0};
    double length = 0, width = 0;
    double passed = 0;  ///< volume since the strip's switch, mm³
    std::size_t lane = 0;
  };

  explicit Bead(const Strip& strip) {
    double passed = 0;
    const std::size_t before = strip.bead.size() + 1 - strip.points.size();
    for (std::size_t i = 0; i < before; ++i) passed -= strip.bead[i].volume;
    Vec2 here = strip.start;
    Shade shade = Shade::from;
    bool across = false;
    std::size_t lane = 0;
    for (std::size_t i = 0; i < strip.bead.size(); ++i) {
      const StripMove& move = strip.bead[i];
      if (move.shade != shade) switches_.push_back({passed, share_of(move.shade) - share_of(shade)});
      shade = move.shade;
      const Vec2 way = move.to - here;
      const bool turning = std::abs(way.x()) <= 0.9 * way.norm();
      if (turning && !across) ++lane;
      across = turning;
      if (!turning) cut(strip, here, move, passed, lane, i < before ? fill_step : along_step);
      passed += move.volume;
      here = move.to;
    }
  }

  const std::vector<Piece>& pieces() const { return pieces_; }
  const std::vector<MixtureSwitch>& switches() const { return switches_; }

 private:
  static double share_of(Shade shade) { return shade_shares[static_cast<std::size_t>(shade)]; }

  void cut(const Strip& strip, const Vec2& from, const StripMove& move, double passed, std::size_t lane,
           double step) {
    const Vec2 way = move.to - from;
    const double length = way.norm(), count = std::max(1.0, std::round(length / step));
    for (double i = 0; i < count; ++i) {
      const double part = (i + 0.5) / count;
      pieces_.push_back({from + part * way, way / length, length / count,
                         move.volume / length / strip.layer_height, passed + part * move.volume, lane});
    }
  }

  std::vector<Piece> pieces_;
  std::vector<MixtureSwitch> switches_;
};

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
  // If a printer can lay one width only, all lines are thin and fat alike.
  const double thin = strip.thin_width, thicker = strip.fat_width - thin;
  const bool two_widths = thicker > 0.05 * thin;
  const auto fatness = [&](double width) {
    return two_widths ? std::clamp((width - thin) / thicker, 0.0, 1.0) : 0.0;
  };
  std::vector<PurePlace> places;
  for (const Strip::Lane& lane : strip.straight) {
    if (!lane.pure) continue;
    // The lanes before the marks lie far from the strip.
    const bool purge = lane.from.y() < strip.start.y();
    add_line(sheet, lane, purge ? purge_material : material_of(lane.shade, fatness(lane.width) > 0.5),
             pure_step, places);
  }
  for (const Strip::Lane& tick : strip.ticks) add_line(sheet, tick, tick_material, tick.width + 100, places);
  for (const Vec2& centre : strip.round_marks) add_round_mark(sheet, centre, strip.line_width, places);
  const EvenLight even = even_light(places, strip);
  const ReferenceLines thin_lines(places, even, false), fat_lines(places, even, two_widths);
  check_all_seen(thin_lines, file);
  check_all_seen(fat_lines, file);
  check_brightness(thin_lines, file);
  check_brightness(fat_lines, file);
  check_contrast(thin_lines, fat_lines, file);
  StripCurve curve;
  curve.references = {thin_lines.colours(), fat_lines.colours()};
  check_order(curve.references, file);
  const Seen at_lines = even.brightness((strip.references.front() + strip.references.back()) / 2);
  const Bead bead(strip);
  curve.switches = bead.switches();
  for (const Bead::Piece& piece : bead.pieces()) {
    const double width = piece.width;
    CurvePoint point{
        piece.passed, {},         fatness(width), 0, minus(even.brightness(piece.place), at_lines),
        piece.lane,   piece.place};
    const SeenLight seen = sheet.light(piece.place, piece.direction, piece.length / 2, core_part * width);
    if (seen.pixels > 0 && seen.clipped <= clipped_at_most) {
      point.colour = encoded(even.evened(piece.place, seen.light));
      point.trust = 1;
    }
    curve.points.push_back(point);
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
