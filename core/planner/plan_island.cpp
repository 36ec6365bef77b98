#include "core/planner/plan_island.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <utility>

#include "core/curve/clearance.hpp"
#include "core/curve/evenness.hpp"
#include "core/geometry/segment_diagram.hpp"
#include "core/planner/fill_region.hpp"
#include "core/planner/measure.hpp"
#include "core/planner/stages.hpp"
#include "core/planner/stopwatch.hpp"
#include "core/planner/zones_along.hpp"

namespace unicursal::core {
namespace {

constexpr double strokes_every = 1.5;  ///< bead widths between the samples of the asked directions

void measure_widths(PlannedCurve& planned, const PlanOptions& options) {
  const std::vector<double> widths = widths_around(planned.path, options.bead_width);
  for (std::size_t i = 0; i < widths.size(); ++i) {
    const bool narrow = std::max(widths[i], planned.path.width(i)) < options.min_bead_width;
    if (narrow && planned.path.beads[i].area > 0) planned.narrow_length += planned.path.length(i);
    if (options.max_bead_width && widths[i] > *options.max_bead_width)
      planned.wide_length += planned.path.length(i);
  }
}

/// Where a curve runs straight, as along straight borders or after few steps of fairing, the exact diagram
/// has to decide every predicate with rational numbers: 60 s instead of 1 s for 30 000 vertices. So vertices
/// on straight lines are moved by amounts too small to matter.
void leave_straight_lines(Ring& ring, double bead_width, std::uint64_t seed) {
  constexpr double straight = 1e-3;  // sine of the turn
  constexpr double most = 2e-4;      // greatest move along each axis, bead widths
  Random random(seed);
  const Ring before = ring;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2 in = before[i] - before[(i + ring.size() - 1) % ring.size()];
    const Vec2 out = before[(i + 1) % ring.size()] - before[i];
    if (std::abs(cross(in, out)) < straight * in.norm() * out.norm()) {
      // The language leaves open which argument is computed first.
      const double y = random.uniform(-1, 1), x = random.uniform(-1, 1);
      ring[i] += most * bead_width * Vec2(x, y);
    }
  }
}

PlannedCurve finish(RegionCurve& filled, const FillableRegion& part, IslandWork& work) {
  const Stopwatch watch(work.plan.widths);
  const double w = work.width();
  const Curve exact = filled.curve;
  leave_straight_lines(filled.curve.vertices, w, work.options.seed);
  if (!sound(filled.curve, part.region, w)) filled.curve = exact;
  const SegmentDiagram diagram = segment_diagram(filled.curve.vertices, part.region, &work.workers);
  PlannedCurve planned;
  planned.area = area(part.region);
  std::vector<double> areas = segment_areas(diagram, filled.curve, w);
  empty_ways_back(filled.curve, filled.one_way, areas);
  planned.path = along_zones(filled.curve, areas, work.island);
  planned.objectives = objectives(diagram, filled.curve, planned.area, w, work.demands.field());
  measure_path(planned.path, work.zones, w, planned.objectives);
  measure_widths(planned, work.options);
  planned.zone_crossings = material_changes(planned.path, work.zones);
  planned.self_intersections = self_intersections(filled.curve);
  planned.outside_segments = segments_outside(filled.curve, BorderIndex(part.region, w));
  planned.faired = filled.faired;
  planned.perimeters = filled.perimeters;
  planned.split_and_reconnect = filled.split_and_reconnect;
  planned.doubled_edges = filled.doubled_edges;
  const Holes holes = look_for_holes(filled.curve, part.region, w, &work.workers);
  planned.farthest = holes.farthest;
  work.plan.far_area += holes.area;
  return planned;
}

}  // namespace

struct IslandPlanner::Directions {
  ZoneDirections files;
};

IslandPlanner::IslandPlanner(std::vector<Zone> zones)
    : zones_(std::move(zones)),
      directions_(std::make_shared<const Directions>(Directions{read_zone_directions(zones_)})) {}

IslandPlan IslandPlanner::plan(const Island& island, double z, const PlanOptions& options) const {
  assert(options.bead_width > 0 && !island.zones.empty());
  IslandPlan times;
  std::optional<Demands> demands;
  Fillable parts;
  {
    const Stopwatch watch(times.graph);
    demands.emplace(island, zones_, directions_->files, z, options.bead_width);
    parts = fillable(island.outline, options.bead_width, half_width(options));
  }
  const Effort* recorded = options.recorded ? &*options.recorded : nullptr;
  IslandWork work{island,
                  zones_,
                  options,
                  *demands,
                  settings(options.preset, options.quality),
                  Random(options.seed),
                  StepBudget(options.budget_spent, recorded),
                  std::move(times),
                  Workers(options.threads)};
  work.plan.unfilled_area = parts.too_thin;
  if (options.stages != nullptr)
    *options.stages = {asked_directions(demands->field(), island.outline, strokes_every * options.bead_width),
                       {}};
  for (const FillableRegion& part : parts.regions) {
    std::optional<RegionCurve> curve = fill_region(part, parts.regions.size() == 1, work);
    if (!curve) {
      work.plan.unfilled_area += area(part.region);
      continue;
    }
    work.plan.curves.push_back(finish(*curve, part, work));
    if (options.stages != nullptr)
      std::move(curve->cycles.begin(), curve->cycles.end(), std::back_inserter(options.stages->cycles));
  }
  work.plan.effort = work.budget.steps();
  return std::move(work.plan);
}

bool IslandPlanner::fits(const Island& island, const PlanOptions& options) const {
  return !fillable(island.outline, options.bead_width, half_width(options)).regions.empty();
}

IslandPlan plan_island(const Island& island, const std::vector<Zone>& zones, const PlanOptions& options) {
  return IslandPlanner(zones).plan(island, 0, options);
}

}  // namespace unicursal::core
