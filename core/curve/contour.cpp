#include "core/curve/contour.hpp"

#include <algorithm>

#include "core/curve/clearance.hpp"
#include "core/curve/resample.hpp"
#include "core/geometry/border_index.hpp"
#include "core/geometry/region.hpp"

namespace unicursal::core {
namespace {

constexpr double depths[] = {0.5, 0.4, 0.3, 0.2, 0.1, 0.05};  ///< bead widths inside the border
constexpr double bend = 0.01;         ///< bead widths by which simplification may move the contour
constexpr double least_length = 0.7;  ///< shortest contour, as a share of area ÷ bead width
constexpr std::size_t fewest_vertices = 5;

}  // namespace

std::optional<Curve> contour(const Polygon& region, double bead_width) {
  const BorderIndex border(region, bead_width);
  for (const double depth : depths) {
    const Region inner = offset({region}, -depth * bead_width, 0.02 * bead_width);
    if (inner.empty()) continue;
    const auto widest = std::max_element(inner.begin(), inner.end(), [](const Polygon& l, const Polygon& r) {
      return perimeter(l.outer) < perimeter(r.outer);
    });
    // Half a bead inside a tiny island the offset is hardly more than a point.
    if (widest->outer.size() < 3 || perimeter(widest->outer) < least_length * area(region) / bead_width)
      continue;
    Curve curve{simplified(widest->outer, bend * bead_width)};
    while (curve.size() < fewest_vertices) curve = subdivided(curve);
    if (self_intersections(curve) == 0 && segments_outside(curve, border) == 0) return curve;
  }
  return std::nullopt;
}

}  // namespace unicursal::core
