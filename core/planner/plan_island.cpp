#include "core/planner/plan_island.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "core/curve/alignment.hpp"
#include "core/curve/clearance.hpp"
#include "core/curve/contour.hpp"
#include "core/curve/fairing.hpp"
#include "core/curve/join.hpp"
#include "core/curve/shape_terms.hpp"
#include "core/cycle/first_cycle.hpp"
#include "core/field/make_direction_field.hpp"
#include "core/geometry/lattice.hpp"
#include "core/geometry/lattice_owners.hpp"
#include "core/geometry/region.hpp"
#include "core/geometry/segment_diagram.hpp"
#include "core/graph/cell_graph.hpp"
#include "core/planner/fillable.hpp"
#include "core/planner/stopwatch.hpp"
#include "core/planner/with_perimeters.hpp"
#include "core/planner/zones_along.hpp"

namespace unicursal::core {
namespace {

/// d ÷ bead width, measured (tests/bench/spacing): the first cycle then starts within a tenth of the asked
/// spacing; less covers a little better but costs more cells.
constexpr double seed_distance_in_widths = 1.4;
constexpr double aligned_seed_distance = 1.05;  ///< the same where directions are asked for
constexpr double least_field = 0.1;             ///< ‖V‖ below which a place asks for no direction
constexpr double rewarded_angle = 0.55;         ///< rad off the field up to which running there is rewarded
constexpr double fields_per_width = 4;          ///< squares of the direction field per bead width
constexpr double fewest_cells = 2.5;            ///< an island of less gets a contour
constexpr int tries = 8;                        ///< with other seeds, before a contour is taken instead
constexpr double least_half_width = 0.15, most_half_width = 0.3;  ///< bead widths, half of what can be passed
constexpr std::size_t most_pieces = 50;  ///< of materials in one island, to be joined one by one
constexpr double speck = 0.05;           ///< square bead widths; no curve of its own below that
constexpr double most_thin = 0.002;      ///< of a piece of one material that its own curve may leave out
constexpr double far = 1.2;              ///< bead widths; farther than that is a hole in the layer
constexpr double nearly_far = 1.0;       ///< bead widths; where fairing for direction gives up
constexpr double far_samples = 8;        ///< lattice squares per bead width when looking for such

/// A closed curve on its way through the stages.
struct Draft {
  Curve curve;
  std::size_t split_and_reconnect = 0, doubled_edges = 0;
  bool faired = false;
  int perimeters = 0;
};

double half_width(const PlanOptions& options) {
  const double asked = options.min_bead_width / 2 / options.bead_width;
  return options.bead_width * std::clamp(asked > 0 ? asked : 0.25, least_half_width, most_half_width);
}

bool sound(const Curve& curve, const Polygon& region, double bead_width) {
  return curve.size() >= 5 && self_intersections(curve) == 0 &&
         segments_outside(curve, BorderIndex(region, bead_width)) == 0;
}

/// What all stages of one island share.
struct Work {
  const Island& island;
  const std::vector<Zone>& zones;
  const PlanOptions& options;
  const DirectionField& field;
  Random random;
  IslandPlan plan;

  double width() const { return options.bead_width; }
};

/// Running along the field is rewarded, running across it costs; 0 where nothing is asked.
RunCost run_cost(const DirectionField& field) {
  if (field.empty()) return {};
  return [&field](const Vec2& a, const Vec2& b) {
    const Vec2 asked = field.at((a + b) / 2), u = b - a;
    if (asked.norm() < least_field || u.squaredNorm() == 0) return 0.0;
    const double off = std::remainder(std::atan2(u.y(), u.x()) - direction(asked), std::numbers::pi);
    return asked.norm() * u.norm() * (off * off - rewarded_angle * rewarded_angle);
  };
}

bool mostly_aligned(const Polygon& piece, const Work& work) {
  if (work.field.empty()) return false;
  const Lattice lattice = sample(piece, std::max(work.width(), bounds(piece).size().maxCoeff() / 1000));
  double aligned = 0;
  for (std::size_t k = 0; k < lattice.size(); ++k) {
    if (lattice.weight[k] <= 0) continue;
    aligned += lattice.weight[k] * work.field.at(lattice.origin + Vec2(lattice.x[k], lattice.y[k])).norm();
  }
  return aligned > area(piece) / 2;
}

/// A piece that is mostly to be aligned wants more cells: its first cycle bends less.
double seed_distance(const Polygon& piece, const Work& work) {
  if (work.options.seed_distance) return *work.options.seed_distance;
  return work.width() * (mostly_aligned(piece, work) ? aligned_seed_distance : seed_distance_in_widths);
}

std::optional<Draft> cycle_draft(const FillableRegion& part, double d, Work& work) {
  for (int attempt = 0; attempt < tries; ++attempt) {
    std::optional<CellGraph> graph;
    {
      const Stopwatch watch(work.plan.graph);
      graph = make_cell_graph(part.domain, d, work.random);
    }
    if (!graph) continue;
    const Stopwatch watch(work.plan.cycle);
    const std::optional<Cycle> cycle = first_cycle(*graph, run_cost(work.field));
    if (cycle && sound(cycle->curve, part.region, work.width())) {
      return Draft{cycle->curve, cycle->split_and_reconnect, cycle->doubled_edges, false};
    }
  }
  return std::nullopt;
}

std::optional<Draft> first_draft(const FillableRegion& part, Work& work) {
  const double d = seed_distance(part.region, work);
  if (area(part.domain) > fewest_cells * std::sqrt(3) / 2 * d * d) {
    if (std::optional<Draft> draft = cycle_draft(part, d, work)) return draft;
  }
  const Stopwatch watch(work.plan.graph);
  if (std::optional<Curve> curve = contour(part.region, work.width()))
    return Draft{std::move(*curve), 0, 0, false};
  return std::nullopt;
}

/// The farthest that a point of the region, opened by a disc of one bead width, is from the curve, and the
/// area that is too far.
struct Holes {
  double farthest = 0;  ///< mm
  double area = 0;      ///< mm²
};

Holes look_for_holes(const Curve& curve, const Polygon& region, double w) {
  std::vector<Segment> segments(curve.size());
  for (std::size_t i = 0; i < curve.size(); ++i) {
    segments[i] = {curve.vertices[i], curve.vertices[curve.after(i)]};
  }
  Holes holes;
  for (const Polygon& piece : opened({region}, w / 2, 0.005 * w)) {
    const double extent = bounds(piece).size().maxCoeff();
    const Lattice lattice = sample(piece, std::max(w / far_samples, extent / 30000));
    LatticeOwners owners(lattice);
    owners.assign(segments, 1.25 * far * w);
    for (std::size_t k = 0; k < lattice.size(); ++k) {
      if (lattice.weight[k] <= 0 || owners.owner(k) < 0) continue;
      const double distance = std::sqrt(static_cast<double>(owners.distance2(k)));
      holes.farthest = std::max(holes.farthest, distance);
      if (distance > far * w) holes.area += lattice.weight[k];
    }
  }
  return holes;
}

/// Fairing, unless it breaks something, which only rounding could make it do. Strands held straight may leave
/// a hole where their number does not fit the width; coverage then goes before direction.
void fair_draft(Draft& draft, const FillableRegion& part, Work& work) {
  const Stopwatch watch(work.plan.fairing);
  const double w = work.width();
  FairingOptions fairing;
  fairing.bead_width = w;
  fairing.target_length = area(part.region) / w;
  fairing.hold_length = !part.thin;
  fairing.field = &work.field;
  Curve result = fair(smoothed(draft.curve, part.region, w), part.region, fairing).curve;
  if (!work.field.empty() && look_for_holes(result, part.region, w).farthest > nearly_far * w) {
    fairing.field = nullptr;
    result = fair(result, part.region, fairing).curve;
  }
  draft.faired = sound(result, part.region, w);
  if (draft.faired) draft.curve = std::move(result);
}

/// The segments within `reach` mm of a vertex along the curve, with the length of each that lies there.
std::vector<std::pair<std::size_t, double>> around(const Curve& curve, std::size_t vertex, double reach) {
  const auto length = [&](std::size_t i) {
    return (curve.vertices[curve.after(i)] - curve.vertices[i]).norm();
  };
  std::vector<std::pair<std::size_t, double>> found;
  double left = reach;
  for (std::size_t i = vertex, n = 0; left > 0 && n < curve.size() / 2; i = curve.after(i), ++n) {
    found.emplace_back(i, std::min(length(i), left));
    left -= length(i);
  }
  left = reach;
  for (std::size_t i = curve.before(vertex), n = 0; left > 0 && n < curve.size() / 2;
       i = curve.before(i), ++n) {
    found.emplace_back(i, std::min(length(i), left));
    left -= length(i);
  }
  return found;
}

/// Segment areas: each segment's own cell and its share of the cells of vertices. The paper (§3.4) gives half
/// of a vertex's cell to either neighbour, which makes a blob of a short segment at the tip of a hairpin;
/// here all segments within half a bead width share by length.
std::vector<double> segment_areas(const SegmentDiagram& diagram, const Curve& curve, double w) {
  std::vector<double> areas(curve.size());
  for (std::size_t i = 0; i < curve.size(); ++i) {
    areas[i] += diagram.segments[i].area;
    const auto neighbours = around(curve, i, w / 2);
    double total = 0;
    for (const auto& [segment, length] : neighbours) total += length;
    for (const auto& [segment, length] : neighbours)
      areas[segment] += length / total * diagram.points[i].area;
  }
  return areas;
}

CurveObjectives objectives(const SegmentDiagram& diagram, const Curve& curve, double region_area,
                           const Work& work) {
  CurveObjectives result;
  for (const auto* cells : {&diagram.points, &diagram.segments}) {
    for (const CellIntegrals& cell : *cells) result.coverage += cell.second_moment;
  }
  const double length = curve.length(), width = region_area / length, target = region_area / work.width();
  result.normalised_coverage = result.coverage / (region_area * width * width);
  result.length = (length - target) * (length - target);
  result.smoothness = smoothness(curve);
  result.alignment = mean_squared_angle(curve, work.field);
  return result;
}

PlannedCurve finish(const Draft& draft, const FillableRegion& part, Work& work) {
  const Stopwatch watch(work.plan.widths);
  const double w = work.width();
  const SegmentDiagram diagram = segment_diagram(draft.curve.vertices, part.region);
  PlannedCurve planned;
  planned.area = area(part.region);
  planned.path = along_zones(draft.curve, segment_areas(diagram, draft.curve, w), work.island);
  planned.objectives = objectives(diagram, draft.curve, planned.area, work);
  planned.zone_crossings = material_changes(planned.path, work.zones);
  planned.self_intersections = self_intersections(draft.curve);
  planned.outside_segments = segments_outside(draft.curve, BorderIndex(part.region, w));
  planned.faired = draft.faired;
  planned.perimeters = draft.perimeters;
  planned.split_and_reconnect = draft.split_and_reconnect;
  planned.doubled_edges = draft.doubled_edges;
  const Holes holes = look_for_holes(draft.curve, part.region, w);
  planned.farthest = holes.farthest;
  work.plan.far_area += holes.area;
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
std::optional<Draft> draft_by_material(const FillableRegion& part, Work& work) {
  const double w = work.width();
  const std::vector<Polygon> pieces = material_pieces(work.island, work.zones, w);
  if (pieces.size() < 2 || pieces.size() > most_pieces) return std::nullopt;
  Draft sum;
  std::vector<Curve> curves;
  for (const Polygon& piece : pieces) {
    const Fillable parts = fillable(piece, w, half_width(work.options));
    if (parts.too_thin > most_thin * area(piece) || parts.regions.size() != 1) return std::nullopt;
    std::optional<Draft> draft = first_draft(parts.regions.front(), work);
    if (!draft) return std::nullopt;
    fair_draft(*draft, parts.regions.front(), work);
    if (!draft->faired) return std::nullopt;
    sum.split_and_reconnect += draft->split_and_reconnect;
    sum.doubled_edges += draft->doubled_edges;
    curves.push_back(std::move(draft->curve));
  }
  const Stopwatch watch(work.plan.fairing);
  std::optional<Curve> one = joined(std::move(curves), part.region, w);
  if (!one || !sound(*one, part.region, w)) return std::nullopt;
  sum.curve = std::move(*one);
  sum.faired = true;
  return sum;
}

/// Contours and fill in one curve, by material where that works.
std::optional<Draft> draft_with_perimeters(const FillableRegion& part, bool whole_island, int count,
                                           Work& work) {
  Draft sum;
  const FillRegion fill = [&](const FillableRegion& region) -> std::optional<Curve> {
    std::optional<Draft> draft = first_draft(region, work);
    if (draft) fair_draft(*draft, region, work);
    if (!draft || !draft->faired) return std::nullopt;
    sum.split_and_reconnect += draft->split_and_reconnect;
    sum.doubled_edges += draft->doubled_edges;
    return std::move(draft->curve);
  };
  std::vector<std::vector<Polygon>> divisions{{part.region}};
  if (whole_island && work.island.zones.size() > 1)
    divisions.insert(divisions.begin(), material_pieces(work.island, work.zones, work.width()));
  for (const std::vector<Polygon>& pieces : divisions) {
    if (pieces.empty() || pieces.size() > most_pieces) continue;
    sum = {};
    std::optional<Outlined> one =
        with_perimeters(part.region, pieces, {count, work.width(), half_width(work.options)}, fill);
    if (!one || !sound(one->curve, part.region, work.width())) continue;
    sum.curve = std::move(one->curve);
    sum.faired = true;
    sum.perimeters = one->perimeters;
    return sum;
  }
  return std::nullopt;
}

std::optional<Draft> draft_for(const FillableRegion& part, bool whole_island, Work& work) {
  for (int count = work.options.perimeters; count > 0; count /= 2) {
    if (std::optional<Draft> draft = draft_with_perimeters(part, whole_island, count, work)) return draft;
  }
  if (whole_island && work.island.zones.size() > 1) {
    if (std::optional<Draft> draft = draft_by_material(part, work)) return draft;
  }
  std::optional<Draft> draft = first_draft(part, work);
  if (draft) fair_draft(*draft, part, work);
  return draft;
}

/// The direction in which a zone of an island reaches farthest: its principal axis.
double principal_axis(const ZoneRegion& region) {
  Vec2 center(0, 0);
  double total = 0;
  std::vector<std::pair<Vec2, double>> samples;
  for (const Polygon& polygon : region.polygons) {
    const Lattice lattice = sample(polygon, std::max(bounds(polygon).size().maxCoeff() / 50, 1e-6));
    for (std::size_t k = 0; k < lattice.size(); ++k) {
      if (lattice.weight[k] <= 0) continue;
      samples.emplace_back(lattice.origin + Vec2(lattice.x[k], lattice.y[k]), lattice.weight[k]);
      center += samples.back().second * samples.back().first;
      total += samples.back().second;
    }
  }
  center /= total;
  Vec2 doubled_axis(0, 0);
  for (const auto& [point, weight] : samples) {
    const Vec2 r = point - center;
    doubled_axis += weight * Vec2(r.x() * r.x() - r.y() * r.y(), 2 * r.x() * r.y());
  }
  // A square has none: then along x.
  return doubled_axis.norm() > 1e-3 * total * total ? direction(doubled_axis) : 0.0;
}

/// An anisotropic zone may choose its direction (52): the one with the fewest turns, along its longest way.
std::vector<Zone> with_directions(std::vector<Zone> zones, const Island& island) {
  for (const ZoneRegion& region : island.zones) {
    Pattern& pattern = zones[region.zone].pattern;
    if (pattern.kind != PatternKind::anisotropic) continue;
    pattern.kind = PatternKind::angle;
    pattern.angle = principal_axis(region);
  }
  return zones;
}

bool asks_for_directions(const std::vector<Zone>& zones) {
  return std::any_of(zones.begin(), zones.end(), [](const Zone& zone) {
    return zone.pattern.kind != PatternKind::none && zone.pattern.kind != PatternKind::isotropic;
  });
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
  DirectionField field;
  Fillable parts;
  {
    const Stopwatch watch(times.graph);
    if (asks_for_directions(zones_)) {
      field = make_direction_field(island, with_directions(zones_, island), directions_->files, z,
                                   options.bead_width / fields_per_width);
    }
    parts = fillable(island.outline, options.bead_width, half_width(options));
  }
  Work work{island, zones_, options, field, Random(options.seed), times};
  work.plan.unfilled_area = parts.too_thin;
  for (const FillableRegion& part : parts.regions) {
    const std::optional<Draft> draft = draft_for(part, parts.regions.size() == 1, work);
    if (!draft) {
      work.plan.unfilled_area += area(part.region);
      continue;
    }
    work.plan.curves.push_back(finish(*draft, part, work));
  }
  return std::move(work.plan);
}

IslandPlan plan_island(const Island& island, const std::vector<Zone>& zones, const PlanOptions& options) {
  return IslandPlanner(zones).plan(island, 0, options);
}

}  // namespace unicursal::core
