#include "host/photo/sheet.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "host/photo/find_marks.hpp"

namespace unicursal::host {
namespace {

using core::Vec2;

constexpr std::size_t most_candidates = 12;
constexpr double mark_tolerance = 0.03;   ///< of the longer diagonal: lenses bend lines
constexpr double size_tolerance = 1.35;   ///< factor between the seen and the expected size of a mark
constexpr double mark_doubt = 0.12;       ///< mm
constexpr double stroke_doubt = 0.08;     ///< mm
constexpr double chunk_length = 4;        ///< mm of a stroke that are looked at together
constexpr double profile_step = 0.05;     ///< mm
constexpr double least_contrast = 0.025;  ///< between a stroke and the bed beside it, encoded values
constexpr double off_the_line = 0.25;     ///< mm; a stroke farther away was not found
constexpr double most_slant =
    2.7;  ///< lengths in front ÷ lengths behind; blur and gloss then differ too much
constexpr double least_photo_scale = 3.5;  ///< pixels per mm

constexpr const char* again =
    "take it again from above, with all six round marks in it, sharp and in even light";

using Corners = std::array<Vec2, 4>;

struct Assignment {
  Corners corners{};
  std::vector<Sighting> marks;
  double cost = 0;
};

core::Box box_of(const MarkPlaces& marks) {
  return {marks[0], marks[2]};
}

/// How well the candidates fit if four of them are the corners. Nothing if they do not.
std::optional<Assignment> assigned(const std::vector<FoundMark>& found, const Corners& corners,
                                   const std::array<double, 4>& radii, const SheetPlan& plan,
                                   const Vec2& size) {
  const View view(box_of(plan.marks), corners, size);
  if (!view.possible()) return std::nullopt;
  const double diagonal = std::max((corners[2] - corners[0]).norm(), (corners[3] - corners[1]).norm());
  const double radius = MarkSizes(plan.line).ring_outer;
  const auto size_fits = [&](const Vec2& place, double seen) {
    const auto [x, y] = view.steps_at(place);
    const double wanted = radius * std::sqrt(std::abs(x.x() * y.y() - x.y() * y.x()));
    return seen < wanted * size_tolerance && seen > wanted / size_tolerance;
  };
  Assignment result{corners, {}, 0};
  for (std::size_t i = 0; i < 4; ++i) {
    if (!size_fits(plan.marks[i], radii[i])) return std::nullopt;
    result.marks.push_back({plan.marks[i], corners[i], {0, 0}, 1});
  }
  for (std::size_t i = 4; i < mark_count; ++i) {
    const Vec2 wanted = view.pixel_of(plan.marks[i]);
    double nearest = mark_tolerance;
    const FoundMark* best = nullptr;
    for (const FoundMark& mark : found) {
      const double off = (mark.centre - wanted).norm() / diagonal;
      if (off >= nearest || !size_fits(plan.marks[i], mark.radius)) continue;
      nearest = off;
      best = &mark;
    }
    result.cost += nearest;
    if (best != nullptr) result.marks.push_back({plan.marks[i], best->centre, {0, 0}, 1});
  }
  if (result.marks.size() == 4) return std::nullopt;  // nothing shows how the print is turned
  return result;
}

Assignment find_corners(const Photo& photo, const SheetPlan& plan, const std::filesystem::path& file) {
  std::vector<FoundMark> found = find_marks(photo);
  if (found.size() > most_candidates) found.resize(most_candidates);
  const Vec2 size(static_cast<double>(photo.width()), static_cast<double>(photo.height()));
  std::optional<Assignment> best;
  const std::size_t n = found.size();
  for (std::size_t a = 0; a < n; ++a) {
    for (std::size_t b = 0; b < n; ++b) {
      for (std::size_t c = 0; c < n; ++c) {
        for (std::size_t d = 0; d < n; ++d) {
          if (a == b || a == c || a == d || b == c || b == d || c == d) continue;
          const Corners corners{found[a].centre, found[b].centre, found[c].centre, found[d].centre};
          auto one =
              assigned(found, corners, {found[a].radius, found[b].radius, found[c].radius, found[d].radius},
                       plan, size);
          if (one && (!best || one->cost < best->cost)) best = std::move(one);
        }
      }
    }
  }
  if (best) return *best;
  throw core::DataError(
      file.string(), "",
      fmt::format("does not show the six round marks of this print ({} places look like one)", n),
      fmt::format("{}, or name the four corner marks with --corners", again));
}

/// Encoded colour, mean over `samples` places along a stroke, `across` mm beside its middle.
std::optional<std::array<double, 3>> row_mean(const Photo& photo, const View& view, const Vec2& middle,
                                              const Vec2& along, const Vec2& normal, double half,
                                              double across) {
  constexpr int samples = 9;
  std::array<double, 3> sum{};
  for (int i = 0; i < samples; ++i) {
    const double t = half * (2.0 * i / (samples - 1) - 1);
    const Vec2 pixel = view.pixel_of(middle + t * along + across * normal);
    if (!photo.holds(pixel)) return std::nullopt;
    const auto seen = photo.between(pixel);
    for (std::size_t c = 0; c < 3; ++c) sum[c] += seen[c] / samples;
  }
  return sum;
}

/// Where across its direction a piece of a stroke is seen: mm from where it should be, or nothing.
std::optional<double> offset_of(const Photo& photo, const View& view, const BareStroke& stroke,
                                const Vec2& middle, const Vec2& along, double half, double reach) {
  const Vec2 normal(-along.y(), along.x());
  const double inner = 0.4 * stroke.width, outer = stroke.width / 2 + stroke.clear;
  const auto steps = static_cast<int>(std::ceil((outer + reach) / profile_step));
  std::vector<std::array<double, 3>> profile;
  for (int i = -steps; i <= steps; ++i) {
    const auto seen = row_mean(photo, view, middle, along, normal, half, i * profile_step);
    if (!seen) return std::nullopt;
    profile.push_back(*seen);
  }
  const auto mean = [&](double from, double to, std::size_t channel) {
    const int first = std::max(-steps, static_cast<int>(std::lround(from / profile_step)));
    const int last = std::min(steps, static_cast<int>(std::lround(to / profile_step)));
    double sum = 0;
    for (int i = first; i <= last; ++i) {
      const int place = i + steps;
      sum += profile[static_cast<std::size_t>(place)][channel];
    }
    return sum / std::max(1, last - first + 1);
  };
  // The line differs from both sides in the same way. A step between two fields of the bed does not.
  const auto contrast = [&](double at) {
    double squares = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      const double line = mean(at - inner, at + inner, c);
      const double left = line - mean(at - outer, at - 0.62 * stroke.width, c);
      const double right = line - mean(at + 0.62 * stroke.width, at + outer, c);
      if (left * right > 0) squares += std::min(left * left, right * right) + 0.25 * left * right;
    }
    return std::sqrt(squares);
  };
  const auto positions = static_cast<int>(std::floor(reach / profile_step));
  std::vector<double> contrasts;
  for (int i = -positions; i <= positions; ++i) contrasts.push_back(contrast(i * profile_step));
  const auto best =
      static_cast<std::size_t>(std::max_element(contrasts.begin(), contrasts.end()) - contrasts.begin());
  if (contrasts[best] < least_contrast || best == 0 || best + 1 == contrasts.size()) return std::nullopt;
  // The middle of where the contrast is high is steadier than its peak.
  double weights = 0, places = 0;
  for (std::size_t i = 0; i < contrasts.size(); ++i) {
    if (std::abs(static_cast<double>(i) - static_cast<double>(best)) * profile_step > stroke.width) continue;
    const double weight = std::max(0.0, contrasts[i] - 0.6 * contrasts[best]);
    weights += weight;
    places += weight * (static_cast<double>(i) - positions) * profile_step;
  }
  return places / weights;
}

}  // namespace

Sheet::Sheet(const Photo& photo, const SheetPlan& plan, const std::optional<GivenCorners>& given,
             const std::filesystem::path& file)
    : photo_(photo), view_(box_of(plan.marks), {Vec2(0, 1), Vec2(1, 1), Vec2(1, 0), Vec2(0, 0)}, {1, 1}) {
  const Vec2 size(static_cast<double>(photo.width()), static_cast<double>(photo.height()));
  Assignment found;
  if (given) {
    found.corners = *given;
    for (std::size_t i = 0; i < 4; ++i) found.marks.push_back({plan.marks[i], (*given)[i], {0, 0}, 1});
  } else {
    found = find_corners(photo, plan, file);
  }
  view_ = View(box_of(plan.marks), found.corners, size);
  if (!view_.possible())
    throw core::DataError(file.string(), "--corners",
                          "are not the corners of a print that is seen from above",
                          "name front left, front right, back right and back left, in this order");
  const Vec2 middle = box_of(plan.marks).center();
  const double scale = view_.scale_at(middle);
  if (scale < least_photo_scale)
    throw core::DataError(file.string(), "",
                          fmt::format("is too small: it has {:.1f} pixels per millimetre of the bed", scale),
                          "take it again from nearer, with at least 4 pixels per millimetre");
  check_slant(plan, file);
  for (Sighting& mark : found.marks) mark.doubt = (given ? 4 : 1) * mark_doubt * scale;
  if (found.marks.size() >= 6) fit_view(view_, found.marks, 1);
  if (plan.strokes.empty()) return;
  for (const auto& [reach, lens] :
       {std::pair{0.85, 1}, std::pair{0.6, 1}, std::pair{0.5, 2}, std::pair{0.4, 2}})
    agreement_ = refine(plan, found.marks, reach, static_cast<std::size_t>(lens));
}

void Sheet::check_slant(const SheetPlan& plan, const std::filesystem::path& file) const {
  double least = std::numeric_limits<double>::infinity(), most = 0, along_one_axis = 1;
  for (const std::size_t axis : {0, 1}) {
    double shortest = std::numeric_limits<double>::infinity(), longest = 0;
    for (const Vec2& mark : plan.marks) {
      const double step = view_.steps_at(mark)[axis].norm();
      shortest = std::min(shortest, step);
      longest = std::max(longest, step);
    }
    least = std::min(least, shortest), most = std::max(most, longest);
    along_one_axis = std::max(along_one_axis, longest / shortest);
  }
  if (most <= most_slant * least) return;
  // A print of other proportions is as long everywhere in one direction, and so it seems from far away.
  if (along_one_axis <= std::sqrt(most_slant))
    throw core::DataError(
        file.string(), "",
        fmt::format("shows another print, or is taken at a steep slant: a millimetre is {:.1f} times as long "
                    "one way as the other",
                    most / least),
        "use the profile and the options with which it was printed, and take the photo from above");
  throw core::DataError(
      file.string(), "",
      fmt::format("is taken at a steep slant: a millimetre is {:.1f} times as long in front as behind",
                  most / least),
      "take it again from farther above, so that it is less than two and a half times as long");
}

double Sheet::refine(const SheetPlan& plan, std::vector<Sighting> sightings, double reach, std::size_t lens) {
  std::vector<Sighting> strokes;
  double looked = 0;
  for (const BareStroke& stroke : plan.strokes) {
    const Vec2 way = stroke.to - stroke.from;
    const double length = way.norm();
    const Vec2 along = way / length, normal(-along.y(), along.x());
    const double count = std::max(1.0, std::floor(length / chunk_length));
    for (double i = 0; i < count; ++i) {
      const Vec2 place = stroke.from + way * ((i + 0.5) / count);
      ++looked;
      const auto off =
          offset_of(photo_, view_, stroke, place, along, 0.4 * std::min(chunk_length, length / count), reach);
      if (!off) continue;
      const Vec2 seen = view_.pixel_of(place + *off * normal);
      const auto [x, y] = view_.steps_at(place);
      const Vec2 step = along.x() * x + along.y() * y, across = normal.x() * x + normal.y() * y;
      const Vec2 in_photo = Vec2(-step.y(), step.x()).normalized();
      strokes.push_back({place, seen, in_photo, stroke_doubt * std::abs(across.dot(in_photo))});
    }
  }
  sightings.insert(sightings.end(), strokes.begin(), strokes.end());
  fit_view(view_, sightings, lens);
  const auto found = std::count_if(strokes.begin(), strokes.end(), [&](const Sighting& seen) {
    const double off = (view_.pixel_of(seen.place) - seen.pixel).dot(seen.normal);
    return std::abs(off) / seen.doubt * stroke_doubt < off_the_line;
  });
  return static_cast<double>(found) / looked;
}

SeenLight Sheet::light(const Vec2& place, const Vec2& direction, double half_along,
                       double half_across) const {
  constexpr double pixels_apart = 0.8;
  const Vec2 normal(-direction.y(), direction.x());
  const double step = pixels_apart / view_.scale_at(place);
  const auto count = [&](double half) { return std::max(1, static_cast<int>(std::ceil(2 * half / step))); };
  const int along = count(half_along), across = count(half_across);
  struct Pixel {
    double brightness;
    std::array<double, 3> encoded;
  };
  std::vector<Pixel> pixels;
  SeenLight seen;
  double clipped = 0;
  for (int i = 0; i < along; ++i) {
    for (int j = 0; j < across; ++j) {
      const Vec2 at = place + direction * (half_along * ((2 * i + 1.0) / along - 1)) +
                      normal * (half_across * ((2 * j + 1.0) / across - 1));
      const Vec2 pixel = view_.pixel_of(at);
      if (!photo_.holds(pixel)) return {};
      const auto encoded = photo_.between(pixel);
      clipped += *std::max_element(encoded.begin(), encoded.end()) > 0.996 ? 1 : 0;
      pixels.push_back({encoded[0] + encoded[1] + encoded[2], encoded});
    }
  }
  std::sort(pixels.begin(), pixels.end(),
            [](const Pixel& a, const Pixel& b) { return a.brightness < b.brightness; });
  seen.pixels = pixels.size();
  seen.clipped = clipped / static_cast<double>(pixels.size());
  const std::size_t first = pixels.size() / 4, last = pixels.size() - pixels.size() / 4;
  for (std::size_t i = first; i < last; ++i) {
    for (std::size_t c = 0; c < 3; ++c)
      seen.light[c] += picture::decoded(pixels[i].encoded[c]) / static_cast<double>(last - first);
  }
  return seen;
}

}  // namespace unicursal::host
