#include "core/planner/plan_island.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <utility>

#include "core/curve/clearance.hpp"
#include "core/curve/contour.hpp"
#include "core/curve/fairing.hpp"
#include "core/curve/join.hpp"
#include "core/curve/shape_terms.hpp"
#include "core/cycle/first_cycle.hpp"
#include "core/geometry/lattice.hpp"
#include "core/geometry/lattice_owners.hpp"
#include "core/geometry/region.hpp"
#include "core/geometry/segment_diagram.hpp"
#include "core/graph/cell_graph.hpp"
#include "core/planner/fillable.hpp"
#include "core/planner/stopwatch.hpp"
#include "core/planner/zones_along.hpp"

namespace unicursal::core {
namespace {

/// d ÷ bead width, measured (tests/bench/spacing): the first cycle then starts within a tenth of the asked
/// spacing; less covers a little better but costs more cells.
constexpr double seed_distance_in_widths = 1.4;
constexpr double fewest_cells = 2.5;  ///< an island of less gets a contour
constexpr int tries = 8;              ///< with other seeds, before a contour is taken instead
constexpr double least_half_width = 0.15, most_half_width = 0.3;  ///< bead widths, half of what can be passed
constexpr std::size_t most_pieces = 50;  ///< of materials in one island, to be joined one by one
constexpr double speck = 0.05;           ///< square bead widths; no curve of its own below that
constexpr double most_thin = 0.002;      ///< of a piece of one material that its own curve may leave out
constexpr double far = 1.2;              ///< bead widths; farther than that is a hole in the layer
constexpr double far_samples = 8;        ///< lattice squares per bead width when looking for such

/// A closed curve on its way through the stages.
struct Draft {
  Curve curve;
  std::size_t split_and_reconnect = 0, doubled_edges = 0;
  bool faired = false;
};

double half_width(const PlanOptions& options) {
  const double asked = options.min_bead_width / 2 / options.bead_width;
  return options.bead_width * std::clamp(asked > 0 ? asked : 0.25, least_half_width, most_half_width);
}

bool sound(const Curve& curve, const Polygon& region, double bead_width) {
  return curve.size() >= 5 && self_intersections(curve) == 0 &&
         segments_outside(curve, BorderIndex(region, bead_width)) == 0;
}

std::optional<Draft> cycle_draft(const FillableRegion& part, double d, double w, Random& random,
                                 IslandPlan& plan) {
  for (int attempt = 0; attempt < tries; ++attempt) {
    std::optional<CellGraph> graph;
    {
      const Stopwatch watch(plan.graph);
      graph = make_cell_graph(part.domain, d, random);
    }
    if (!graph) continue;
    const Stopwatch watch(plan.cycle);
    const std::optional<Cycle> cycle = first_cycle(*graph);
    if (cycle && sound(cycle->curve, part.region, w)) {
      return Draft{cycle->curve, cycle->split_and_reconnect, cycle->doubled_edges, false};
    }
  }
  return std::nullopt;
}

std::optional<Draft> first_draft(const FillableRegion& part, const PlanOptions& options, Random& random,
                                 IslandPlan& plan) {
  const double w = options.bead_width, d = options.seed_distance.value_or(seed_distance_in_widths * w);
  if (area(part.domain) > fewest_cells * std::sqrt(3) / 2 * d * d) {
    if (std::optional<Draft> draft = cycle_draft(part, d, w, random, plan)) return draft;
  }
  const Stopwatch watch(plan.graph);
  if (std::optional<Curve> curve = contour(part.region, w)) return Draft{std::move(*curve), 0, 0, false};
  return std::nullopt;
}

/// Fairing, unless it breaks something, which only rounding could make it do.
void fair_draft(Draft& draft, const FillableRegion& part, double w, IslandPlan& plan) {
  const Stopwatch watch(plan.fairing);
  FairingOptions fairing;
  fairing.bead_width = w;
  fairing.target_length = area(part.region) / w;
  fairing.hold_length = !part.thin;
  const Curve smooth = smoothed(draft.curve, part.region, w);
  Curve result = fair(smooth, part.region, fairing).curve;
  draft.faired = sound(result, part.region, w);
  if (draft.faired) draft.curve = std::move(result);
}

/// Segment areas: each segment's own cell and half of the cells of its ends (§3.4).
std::vector<double> segment_areas(const SegmentDiagram& diagram, const Curve& curve) {
  std::vector<double> areas(curve.size());
  for (std::size_t i = 0; i < curve.size(); ++i) {
    areas[i] = diagram.segments[i].area + (diagram.points[i].area + diagram.points[curve.after(i)].area) / 2;
  }
  return areas;
}

CurveObjectives objectives(const SegmentDiagram& diagram, const Curve& curve, double region_area,
                           double target) {
  CurveObjectives result;
  for (const auto* cells : {&diagram.points, &diagram.segments}) {
    for (const CellIntegrals& cell : *cells) result.coverage += cell.second_moment;
  }
  const double length = curve.length(), width = region_area / length;
  result.normalised_coverage = result.coverage / (region_area * width * width);
  result.length = (length - target) * (length - target);
  result.smoothness = smoothness(curve);
  return result;
}

/// How far the part of the region that a disc of one bead width can reach is from the curve.
void look_for_holes(const Curve& curve, const Polygon& region, double w, PlannedCurve& planned,
                    double& far_area) {
  std::vector<Segment> segments(curve.size());
  for (std::size_t i = 0; i < curve.size(); ++i)
    segments[i] = {curve.vertices[i], curve.vertices[curve.after(i)]};
  for (const Polygon& piece : opened({region}, w / 2, 0.005 * w)) {
    const double extent = bounds(piece).size().maxCoeff();
    const Lattice lattice = sample(piece, std::max(w / far_samples, extent / 30000));
    LatticeOwners owners(lattice);
    owners.assign(segments, 1.25 * far * w);
    for (std::size_t k = 0; k < lattice.size(); ++k) {
      if (lattice.weight[k] <= 0 || owners.owner(k) < 0) continue;
      const double distance = std::sqrt(static_cast<double>(owners.distance2(k)));
      planned.farthest = std::max(planned.farthest, distance);
      if (distance > far * w) far_area += lattice.weight[k];
    }
  }
}

PlannedCurve finish(const Draft& draft, const FillableRegion& part, const Island& island,
                    const std::vector<Zone>& zones, double w, IslandPlan& plan) {
  const Stopwatch watch(plan.widths);
  const SegmentDiagram diagram = segment_diagram(draft.curve.vertices, part.region);
  PlannedCurve planned;
  planned.area = area(part.region);
  planned.path = along_zones(draft.curve, segment_areas(diagram, draft.curve), island);
  planned.objectives = objectives(diagram, draft.curve, planned.area, planned.area / w);
  planned.zone_crossings = material_changes(planned.path, zones);
  planned.self_intersections = self_intersections(draft.curve);
  planned.outside_segments = segments_outside(draft.curve, BorderIndex(part.region, w));
  planned.faired = draft.faired;
  planned.split_and_reconnect = draft.split_and_reconnect;
  planned.doubled_edges = draft.doubled_edges;
  look_for_holes(draft.curve, part.region, w, planned, plan.far_area);
  return planned;
}

/// The pieces of the island that hold one material each, specks aside: beads that pass over those take care.
std::vector<Polygon> material_pieces(const Island& island, const std::vector<Zone>& zones, double w) {
  std::map<std::size_t, Region> by_material;
  for (const ZoneRegion& region : island.zones) {
    Region& sum = by_material[zones[region.zone].material];
    sum = sum.empty() ? region.polygons : unite(sum, region.polygons);
  }
  std::vector<Polygon> pieces;
  for (const auto& [material, region] : by_material)
    pieces.insert(pieces.end(), region.begin(), region.end());
  std::erase_if(pieces, [&](const Polygon& piece) { return area(piece) < speck * w * w; });
  return pieces;
}

/// One curve that crosses from material to material as rarely as can be, or nothing where a piece is too thin
/// for a curve of its own or cannot be joined to the others.
std::optional<Draft> draft_by_material(const FillableRegion& part, const Island& island,
                                       const std::vector<Zone>& zones, const PlanOptions& options,
                                       Random& random, IslandPlan& plan) {
  const std::vector<Polygon> pieces = material_pieces(island, zones, options.bead_width);
  if (pieces.size() < 2 || pieces.size() > most_pieces) return std::nullopt;
  const double w = options.bead_width;
  Draft sum;
  std::vector<Curve> curves;
  for (const Polygon& piece : pieces) {
    const Fillable parts = fillable(piece, w, half_width(options));
    if (parts.too_thin > most_thin * area(piece) || parts.regions.size() != 1) return std::nullopt;
    std::optional<Draft> draft = first_draft(parts.regions.front(), options, random, plan);
    if (!draft) return std::nullopt;
    fair_draft(*draft, parts.regions.front(), w, plan);
    if (!draft->faired) return std::nullopt;
    sum.split_and_reconnect += draft->split_and_reconnect;
    sum.doubled_edges += draft->doubled_edges;
    curves.push_back(std::move(draft->curve));
  }
  const Stopwatch watch(plan.fairing);
  std::optional<Curve> one = joined(std::move(curves), part.region, w);
  if (!one || !sound(*one, part.region, w)) return std::nullopt;
  sum.curve = std::move(*one);
  sum.faired = true;
  return sum;
}

std::optional<Draft> draft_for(const FillableRegion& part, bool whole_island, const Island& island,
                               const std::vector<Zone>& zones, const PlanOptions& options, Random& random,
                               IslandPlan& plan) {
  if (whole_island && island.zones.size() > 1) {
    if (std::optional<Draft> draft = draft_by_material(part, island, zones, options, random, plan))
      return draft;
  }
  std::optional<Draft> draft = first_draft(part, options, random, plan);
  if (draft) fair_draft(*draft, part, options.bead_width, plan);
  return draft;
}

}  // namespace

IslandPlan plan_island(const Island& island, const std::vector<Zone>& zones, const PlanOptions& options) {
  assert(options.bead_width > 0 && !island.zones.empty());
  IslandPlan plan;
  Random random(options.seed);
  Fillable parts;
  {
    const Stopwatch watch(plan.graph);
    parts = fillable(island.outline, options.bead_width, half_width(options));
  }
  plan.unfilled_area = parts.too_thin;
  for (const FillableRegion& part : parts.regions) {
    const std::optional<Draft> draft =
        draft_for(part, parts.regions.size() == 1, island, zones, options, random, plan);
    if (!draft) {
      plan.unfilled_area += area(part.region);
      continue;
    }
    plan.curves.push_back(finish(*draft, part, island, zones, options.bead_width, plan));
  }
  return plan;
}

}  // namespace unicursal::core
