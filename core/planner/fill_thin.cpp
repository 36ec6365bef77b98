#include "core/planner/fill_thin.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "core/planner/stopwatch.hpp"
#include "core/thin/strands.hpp"
#include "core/thin/thin_places.hpp"

namespace unicursal::core {
namespace {

// In bead widths.
constexpr double thin_width = 3.6;          ///< a place up to this wide gets one, two or four strands
constexpr double thin_width_of_four = 4.5;  ///< the same, where four have room
// With two contours or more, four strands are just these, and between them is no room for others.
constexpr double thin_width_of_contours = 4.85;
constexpr double most_of_two = 1.2;  ///< of each of two strands; four leave less bare in corners
constexpr double most_single = 1.5;  ///< a ring up to this wide gets a single strand

StrandWidths strand_widths(const PlanOptions& options) {
  const double w = options.bead_width;
  const double least = options.min_bead_width > 0 ? options.min_bead_width : 2 * half_width(options);
  const double most = options.max_bead_width ? std::max(*options.max_bead_width, w) : most_single * w;
  return {w, std::min(least, 2 * half_width(options)), std::min(most_single * w, most),
          std::min(most_of_two * w, most)};
}

/// Strands along the axis ignore directions that are asked for, so that wider places are left to stripes.
ThinPlaces places_in(const Polygon& region, const IslandWork& work) {
  const double w = work.width();
  const bool contours = work.options.perimeters > 1;
  if (contours || !work.demands.mostly_aligned(region)) {
    ThinPlaces places = thin_places(region, w, (contours ? thin_width_of_contours : thin_width_of_four) * w);
    if (places.thin.empty() || have_room(region, places, strand_widths(work.options))) return places;
  }
  return thin_places(region, w, thin_width * w);
}

}  // namespace

std::optional<RegionCurve> fill_thin(const Polygon& region, IslandWork& work, const FillThick& fill_thick) {
  const double w = work.width();
  ThinPlaces places;
  {
    const Stopwatch watch(work.plan.graph);
    places = places_in(region, work);
  }
  if (places.thin.empty()) return std::nullopt;
  RegionCurve whole;
  // Strands along the axis follow the border.
  if (places.thick.empty()) whole.perimeters = std::min(work.options.perimeters, 1);
  std::vector<Curve> curves;
  for (const Polygon& piece : places.thick) {
    for (const FillableRegion& part : fillable(piece, w, half_width(work.options)).regions) {
      std::optional<RegionCurve> filled = fill_thick(part);
      if (!filled) return std::nullopt;
      whole.split_and_reconnect += filled->split_and_reconnect;
      whole.doubled_edges += filled->doubled_edges;
      whole.perimeters = std::max(whole.perimeters, filled->perimeters);
      std::move(filled->cycles.begin(), filled->cycles.end(), std::back_inserter(whole.cycles));
      curves.push_back(std::move(filled->curve));
    }
  }
  const Stopwatch watch(work.plan.fairing);
  std::optional<ThinCurve> laid = lay_strands(region, places, curves, strand_widths(work.options));
  if (!laid || !sound(laid->curve, region, w)) return std::nullopt;
  whole.curve = std::move(laid->curve);
  whole.one_way = std::move(laid->one_way);
  whole.faired = true;
  return whole;
}

}  // namespace unicursal::core
