// Checks that hold for the plan of any island: curves are closed, simple and inside, and no area is lost.
#pragma once

#include <cmath>
#include <cstdint>
#include <string>

#include "core/curve/clearance.hpp"
#include "core/geometry/border_index.hpp"
#include "core/planner/island_plan.hpp"

namespace unicursal::core::test {

constexpr double least_relative_area_error = 1e-9;

/// Options for beads of width `w`.
inline PlanOptions options_for(double w, std::uint64_t seed = 1) {
  PlanOptions options;
  options.bead_width = w;
  options.min_bead_width = 0.55 * w;
  options.seed = seed;
  return options;
}

/// Describes the first fault of a curve; empty for a sound one.
inline std::string fault_of(const PlannedCurve& curve, const Polygon& outline,
                            const std::vector<Zone>& zones) {
  if (curve.self_intersections != 0) return "the curve meets itself";
  if (curve.outside_segments != 0) return "the curve leaves the island";
  if (!curve.faired) return "the curve is not faired";
  if (curve.path.size() < 5) return "fewer than five beads";
  const double sum = curve.path.total_area();
  if (!(std::abs(sum - curve.area) <= least_relative_area_error * curve.area))
    return "beads of " + std::to_string(sum) + " mm² fill " + std::to_string(curve.area) +
           " mm², relative error " + std::to_string((sum / curve.area - 1) * 1e9) + "e-9";
  for (const Bead& bead : curve.path.beads) {
    if (!(bead.area >= -1e-9)) return "a bead of negative area: " + std::to_string(bead.area);
    if (!contains(outline, bead.position)) return "a bead outside of the outline";
    if (bead.zone >= zones.size()) return "a bead in a zone that does not exist";
  }
  const CurveObjectives& o = curve.objectives;
  for (const double value : {o.coverage, o.normalised_coverage, o.length, o.smoothness, o.alignment,
                             o.isotropy, o.anisotropy, o.width_variation, curve.farthest}) {
    if (!(value >= 0 && std::isfinite(value))) return "an objective that is negative or not finite";
  }
  return "";
}

/// Describes the first fault of a plan; empty for a sound one. `w` mm is the bead width.
inline std::string fault_of(const IslandPlan& plan, const Polygon& outline, const std::vector<Zone>& zones,
                            double w) {
  double filled = 0;
  const BorderIndex border(outline, w);
  for (const PlannedCurve& curve : plan.curves) {
    if (const std::string fault = fault_of(curve, outline, zones); !fault.empty()) return fault;
    Curve closed;
    for (const Bead& bead : curve.path.beads) closed.vertices.push_back(bead.position);
    if (segments_outside(closed, border) != 0) return "a bead that crosses the outline";
    filled += curve.area;
  }
  const double lost = area(outline) - filled - plan.unfilled_area;
  const double tolerance = 1e-5 * w * w + least_relative_area_error * area(outline);
  return std::abs(lost) <= tolerance ? "" : std::to_string(lost) + " mm² of the island are lost";
}

}  // namespace unicursal::core::test
