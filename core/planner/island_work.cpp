#include "core/planner/island_work.hpp"

#include <algorithm>

#include "core/curve/clearance.hpp"
#include "core/geometry/border_index.hpp"

namespace unicursal::core {
namespace {

constexpr double least_half_width = 0.15,
                 most_half_width = 0.3;  ///< bead widths; limits of half the least width

}  // namespace

double half_width(const PlanOptions& options) {
  const double asked = options.min_bead_width / 2 / options.bead_width;
  return options.bead_width * std::clamp(asked > 0 ? asked : 0.25, least_half_width, most_half_width);
}

bool sound(const Curve& curve, const Polygon& region, double bead_width) {
  return curve.size() >= 5 && self_intersections(curve) == 0 &&
         segments_outside(curve, BorderIndex(region, bead_width)) == 0;
}

}  // namespace unicursal::core
