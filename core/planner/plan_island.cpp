#include "core/planner/plan_island.hpp"

#include <cassert>
#include <utility>

#include "core/curve/clearance.hpp"
#include "core/geometry/segment_diagram.hpp"
#include "core/planner/draft.hpp"
#include "core/planner/measure.hpp"
#include "core/planner/stopwatch.hpp"
#include "core/planner/zones_along.hpp"

namespace unicursal::core {
namespace {

PlannedCurve finish(const Draft& draft, const FillableRegion& part, IslandWork& work) {
  const Stopwatch watch(work.plan.widths);
  const double w = work.width();
  const SegmentDiagram diagram = segment_diagram(draft.curve.vertices, part.region, &work.workers);
  PlannedCurve planned;
  planned.area = area(part.region);
  planned.path = along_zones(draft.curve, segment_areas(diagram, draft.curve, w), work.island);
  planned.objectives = objectives(diagram, draft.curve, planned.area, w, work.demands.field());
  measure_path(planned.path, work.zones, w, planned.objectives);
  planned.zone_crossings = material_changes(planned.path, work.zones);
  planned.self_intersections = self_intersections(draft.curve);
  planned.outside_segments = segments_outside(draft.curve, BorderIndex(part.region, w));
  planned.faired = draft.faired;
  planned.perimeters = draft.perimeters;
  planned.split_and_reconnect = draft.split_and_reconnect;
  planned.doubled_edges = draft.doubled_edges;
  const Holes holes = look_for_holes(draft.curve, part.region, w, &work.workers);
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
                  Pace(options.enough, recorded),
                  std::move(times),
                  Workers(options.threads)};
  work.plan.unfilled_area = parts.too_thin;
  for (const FillableRegion& part : parts.regions) {
    const std::optional<Draft> curve = draft(part, parts.regions.size() == 1, work);
    if (!curve) {
      work.plan.unfilled_area += area(part.region);
      continue;
    }
    work.plan.curves.push_back(finish(*curve, part, work));
  }
  work.plan.effort = work.pace.spent();
  return std::move(work.plan);
}

bool IslandPlanner::fits(const Island& island, const PlanOptions& options) const {
  return !fillable(island.outline, options.bead_width, half_width(options)).regions.empty();
}

IslandPlan plan_island(const Island& island, const std::vector<Zone>& zones, const PlanOptions& options) {
  return IslandPlanner(zones).plan(island, 0, options);
}

}  // namespace unicursal::core
