#include "core/planner/fill_region.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numbers>
#include <utility>

#include "core/curve/clearance.hpp"
#include "core/curve/contour.hpp"
#include "core/curve/fairing.hpp"
#include "core/curve/join.hpp"
#include "core/cycle/first_cycle.hpp"
#include "core/cycle/shuffle.hpp"
#include "core/geometry/region.hpp"
#include "core/graph/cell_graph.hpp"
#include "core/planner/measure.hpp"
#include "core/planner/stopwatch.hpp"
#include "core/planner/with_perimeters.hpp"

namespace unicursal::core {
namespace {

// All measured over the example jobs (tests/bench/run).
constexpr double seed_distance_in_widths = 2.05;  ///< d ÷ bead width; more cells cost time and crowd strands
constexpr double rows_of_nodes_above = 1.86;      ///< d ÷ bead width; below, zigzags of nodes fit better
constexpr double needle_growth = 1.75;            ///< of the needles' length with d ÷ bead width
// Of the asked length, what the chords of a tour may come to: a tour that is too long crowds its strands.
constexpr double aligned_length = 0.95, free_length = 1.2;
constexpr double longest_needle = 2;  ///< in the paper's lengths
constexpr double fewest_cells = 2.5;  ///< an island of less gets a contour
constexpr int tries = 8;              ///< with other seeds, before a contour is taken instead
constexpr double least_half_width = 0.15, most_half_width = 0.3;  ///< bead widths, half of what can be passed
constexpr std::size_t most_pieces = 50;  ///< of materials in one island, to be joined one by one
constexpr double speck = 0.05;           ///< square bead widths; no curve of its own below that
constexpr double most_thin = 0.002;      ///< of a piece of one material that its own curve may leave out
constexpr double nearly_far = 1.0;       ///< bead widths; where fairing for direction gives up
// Steps of fairing that a budget never takes away: unfaired E is .107 to .12 and the length 30 % short, after
// these E is .090 to .095 and the length as asked.
constexpr int kept_for_fairing = 12;

/// What a piece of the island asks, as far as seeds and schedules depend on it.
struct Wishes {
  bool aligned = false;                 ///< most of it follows directions
  std::optional<double> one_direction;  ///< rad, where they are all alike
};

/// Cells grow along the field as much as brings the strands to the asked spacing: with point seeds strands of
/// zigzags lie d ÷ √3 apart, rows of nodes d ÷ 2, and needles bring them closer. Where the direction is the
/// same everywhere, a tiling in that direction does better than needles.
GraphOptions graph_options(const Wishes& wishes, double d, const IslandWork& work) {
  GraphOptions options;
  options.seeds.d = d;
  const double ratio = d / work.width();
  if (wishes.one_direction) {
    const bool rows_of_nodes = ratio > rows_of_nodes_above;
    options.seeds.rows = *wishes.one_direction + (rows_of_nodes ? std::numbers::pi / 6 : 0.0);
    if (!rows_of_nodes) options.seeds.stretch = std::clamp(ratio / std::numbers::sqrt3, 0.85, 1.2);
  } else if (wishes.aligned) {
    const double length = 1 + needle_growth * (ratio - std::numbers::sqrt3);
    options.needle_length = std::clamp(length, 0.0, longest_needle);
    if (options.needle_length > 0) options.field = &work.demands.field();
  }
  return options;
}

void optimise(Tour& tour, const FillableRegion& part, const Wishes& wishes, IslandWork& work) {
  ShuffleOptions options = work.settings.shuffle;
  options.weights.length = area(part.region) / work.width() * (wishes.aligned ? aligned_length : free_length);
  if (wishes.aligned) {
    options.hot = work.settings.aligned_hot;
    options.cold = work.settings.aligned_cold;
  }
  if (wishes.one_direction) options.sweeps *= work.settings.one_direction_sweeps;
  options.another = work.pace.stage();
  const ShuffleReport report = shuffle(
      tour, work.demands.at(), work.demands.edge_cost(work.settings.edge_alignment), options, work.random);
  work.plan.operations.looks += report.looks;
  work.plan.operations.found += report.found;
  work.plan.operations.accepted += report.accepted;
}

std::optional<Draft> cycle_draft(const FillableRegion& part, double d, IslandWork& work) {
  const Wishes wishes{work.demands.mostly_aligned(part.region), work.demands.one_direction(part.region)};
  for (int attempt = 0; attempt < tries; ++attempt) {
    std::optional<CellGraph> graph;
    {
      const Stopwatch watch(work.plan.graph);
      graph = make_cell_graph(part.domain, graph_options(wishes, d, work), work.random);
    }
    if (!graph) continue;
    const Stopwatch watch(work.plan.cycle);
    std::optional<Cycle> cycle = first_cycle(*graph, work.demands.first_run_cost());
    if (!cycle) continue;
    Draft draft;
    if (work.options.stages != nullptr) {
      draft.cycles.push_back(drawn(*graph));
      draft.cycles.back().first = drawn(cycle->tour).vertices;
    }
    optimise(cycle->tour, part, wishes, work);
    draft.curve = drawn(cycle->tour);
    draft.split_and_reconnect = cycle->split_and_reconnect;
    draft.doubled_edges = cycle->doubled_edges;
    for (CycleStages& stages : draft.cycles) stages.optimised = draft.curve.vertices;
    if (sound(draft.curve, part.region, work.width())) return draft;
  }
  return std::nullopt;
}

std::optional<Draft> first_draft(const FillableRegion& part, IslandWork& work) {
  const double d = work.options.seed_distance.value_or(seed_distance_in_widths * work.width());
  if (area(part.domain) > fewest_cells * std::sqrt(3) / 2 * d * d) {
    if (std::optional<Draft> draft = cycle_draft(part, d, work)) return draft;
  }
  const Stopwatch watch(work.plan.graph);
  if (std::optional<Curve> curve = contour(part.region, work.width())) return Draft{std::move(*curve)};
  return std::nullopt;
}

/// Fairing, unless it breaks something, which only rounding could make it do. Strands held straight may leave
/// a hole where their number does not fit the width; coverage then goes before direction.
void fair_draft(Draft& draft, const FillableRegion& part, IslandWork& work) {
  const Stopwatch watch(work.plan.fairing);
  const double w = work.width();
  FairingOptions fairing = work.settings.fairing;
  fairing.bead_width = w;
  fairing.target_length = area(part.region) / w;
  fairing.hold_length = !part.thin;
  fairing.field = &work.demands.field();
  fairing.workers = &work.workers;
  fairing.zones = work.demands.orientation_zones();
  fairing.another = work.pace.stage(kept_for_fairing);
  Curve result = fair(smoothed(draft.curve, part.region, w, &work.workers), part.region, fairing).curve;
  if (!work.demands.field().empty() &&
      look_for_holes(result, part.region, w, &work.workers).farthest > nearly_far * w) {
    fairing.field = nullptr;
    fairing.another = work.pace.stage();
    result = fair(result, part.region, fairing).curve;
  }
  draft.faired = sound(result, part.region, w);
  if (draft.faired) draft.curve = std::move(result);
}

/// Adds what a part's making has to tell to that of the whole.
void take_over(Draft& sum, Draft& part) {
  sum.split_and_reconnect += part.split_and_reconnect;
  sum.doubled_edges += part.doubled_edges;
  std::move(part.cycles.begin(), part.cycles.end(), std::back_inserter(sum.cycles));
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
std::optional<Draft> draft_by_material(const FillableRegion& part, IslandWork& work) {
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
    take_over(sum, *draft);
    curves.push_back(std::move(draft->curve));
  }
  const Stopwatch watch(work.plan.fairing);
  std::optional<Curve> one = joined(std::move(curves), part.region, w);
  if (!one || !sound(*one, part.region, w)) return std::nullopt;
  sum.curve = std::move(*one);
  sum.faired = true;
  return sum;
}

/// Contours and fill in one curve. `pieces` are the parts of one material each; a single one stands for all.
std::optional<Draft> draft_with_perimeters(const FillableRegion& part, const std::vector<Polygon>& pieces,
                                           int count, IslandWork& work) {
  Draft sum;
  const FillRegion fill = [&](const FillableRegion& region) -> std::optional<Curve> {
    std::optional<Draft> draft = first_draft(region, work);
    if (draft) fair_draft(*draft, region, work);
    if (!draft || !draft->faired) return std::nullopt;
    take_over(sum, *draft);
    return std::move(draft->curve);
  };
  std::optional<Outlined> one =
      with_perimeters(part.region, pieces, {count, work.width(), half_width(work.options)}, fill);
  if (!one || !sound(one->curve, part.region, work.width())) return std::nullopt;
  sum.curve = std::move(one->curve);
  sum.faired = true;
  sum.perimeters = one->perimeters;
  return sum;
}

/// As many contours as can be had: by material, else around all of them, else half as many, down to none.
std::optional<Draft> draft_with_perimeters(const FillableRegion& part, bool by_material, IslandWork& work) {
  const std::vector<Polygon> pieces =
      by_material ? material_pieces(work.island, work.zones, work.width()) : std::vector<Polygon>{};
  for (int count = work.options.perimeters; count > 0; count /= 2) {
    if (pieces.size() > 1 && pieces.size() <= most_pieces) {
      if (std::optional<Draft> found = draft_with_perimeters(part, pieces, count, work)) return found;
    }
    if (std::optional<Draft> found = draft_with_perimeters(part, {part.region}, count, work)) return found;
  }
  return std::nullopt;
}

}  // namespace

double half_width(const PlanOptions& options) {
  const double asked = options.min_bead_width / 2 / options.bead_width;
  return options.bead_width * std::clamp(asked > 0 ? asked : 0.25, least_half_width, most_half_width);
}

bool sound(const Curve& curve, const Polygon& region, double bead_width) {
  return curve.size() >= 5 && self_intersections(curve) == 0 &&
         segments_outside(curve, BorderIndex(region, bead_width)) == 0;
}

std::optional<Draft> draft(const FillableRegion& part, bool by_material, IslandWork& work) {
  by_material = by_material && work.island.zones.size() > 1;
  if (std::optional<Draft> found = draft_with_perimeters(part, by_material, work)) return found;
  if (by_material) {
    if (std::optional<Draft> found = draft_by_material(part, work)) return found;
  }
  std::optional<Draft> found = first_draft(part, work);
  if (found) fair_draft(*found, part, work);
  return found;
}

}  // namespace unicursal::core
