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
#include "core/planner/fill_thin.hpp"
#include "core/planner/measure.hpp"
#include "core/planner/stopwatch.hpp"
#include "core/planner/with_perimeters.hpp"
#include "core/stopping.hpp"
#include "core/stripes/stripe_curve.hpp"

namespace unicursal::core {
namespace {

// All measured over the example jobs (tests/bench/run).
constexpr double seed_distance_in_widths = 2.05;  ///< d ÷ bead width; more cells cost time and crowd strands
constexpr double rows_of_nodes_above = 1.86;      ///< d ÷ bead width; below it, zigzags of nodes fit better
constexpr double needle_growth = 1.75;            ///< of the needles' length per d ÷ bead width
// Target length of a tour's chords as a share of the curve's target length: too long a tour crowds its
// strands.
constexpr double aligned_length = 0.95, free_length = 1.2;
constexpr double longest_needle = 2;     ///< in the paper's lengths
constexpr double fewest_cells = 2.5;     ///< a smaller island gets a contour
constexpr int tries = 8;                 ///< with other seeds, before a contour is used instead
constexpr std::size_t most_pieces = 50;  ///< material pieces of an island that are joined one by one
constexpr double least_piece = 40;       ///< square bead widths, of a piece with or without directions
constexpr double speck = 0.05;           ///< square bead widths; a smaller piece gets no curve of its own
constexpr double most_thin = 0.002;      ///< share of a material piece that its own curve may leave out
constexpr double nearly_far = 1.0;       ///< bead widths; with larger holes, fairing gives up directions
// Square bead widths, and share of the region, that strands along a field may leave bare, as in sharp
// corners.
constexpr double most_bare = 1, bare_share = 0.0005;
// Steps of fairing that are always granted: an unfaired curve has a normalised coverage of 0.107 to 0.12 and
// is 30 % too short; after these steps the coverage is 0.090 to 0.095, and the length is as asked.
constexpr int kept_for_fairing = 12;

/// The directions that a piece of the island asks for, as far as seeds and schedules depend on them.
struct DirectionDemand {
  bool aligned = false;                 ///< most of the piece follows directions
  std::optional<double> one_direction;  ///< rad, if they are all alike
};

/// Needles or rows that bring the strands to the asked spacing. With point seeds, strands of zigzags lie d ÷
/// √3 apart and rows of nodes d ÷ 2; needles bring them closer, since cells then grow along the field. If the
/// direction is the same everywhere, a tiling in that direction is better than needles.
GraphOptions graph_options(const DirectionDemand& asked, double d, const IslandWork& work) {
  GraphOptions options;
  options.seeds.d = d;
  const double ratio = d / work.width();
  if (asked.one_direction) {
    const bool rows_of_nodes = ratio > rows_of_nodes_above;
    options.seeds.rows = *asked.one_direction + (rows_of_nodes ? std::numbers::pi / 6 : 0.0);
    if (!rows_of_nodes) options.seeds.stretch = std::clamp(ratio / std::numbers::sqrt3, 0.85, 1.2);
  } else if (asked.aligned) {
    const double length = 1 + needle_growth * (ratio - std::numbers::sqrt3);
    options.needle_length = std::clamp(length, 0.0, longest_needle);
    if (options.needle_length > 0) options.field = &work.demands.field();
  }
  return options;
}

void optimise(Tour& tour, const FillableRegion& part, const DirectionDemand& asked, IslandWork& work) {
  ShuffleOptions options = work.settings.shuffle;
  options.weights.length = area(part.region) / work.width() * (asked.aligned ? aligned_length : free_length);
  if (asked.aligned) {
    options.hot = work.settings.aligned_hot;
    options.cold = work.settings.aligned_cold;
  }
  if (asked.one_direction) options.sweeps *= work.settings.one_direction_sweeps;
  options.may_continue = work.budget.stage();
  options.workers = &work.workers;
  const ShuffleReport report = shuffle(
      tour, work.demands.at(), work.demands.edge_cost(work.settings.edge_alignment), options, work.random);
  work.plan.operations.looks += report.looks;
  work.plan.operations.found += report.found;
  work.plan.operations.accepted += report.accepted;
}

std::optional<RegionCurve> curve_of_cycle(const FillableRegion& part, double d, IslandWork& work) {
  const DirectionDemand asked{work.demands.mostly_aligned(part.region),
                              work.demands.one_direction(part.region)};
  for (int attempt = 0; attempt < tries; ++attempt) {
    stop_point();
    std::optional<CellGraph> graph;
    {
      const Stopwatch watch(work.plan.graph);
      graph = make_cell_graph(part.domain, graph_options(asked, d, work), work.random);
    }
    if (!graph) continue;
    const Stopwatch watch(work.plan.cycle);
    std::optional<Cycle> cycle = first_cycle(*graph, work.demands.first_run_cost());
    if (!cycle) continue;
    RegionCurve filled;
    if (work.options.stages != nullptr) {
      filled.cycles.push_back(drawn(*graph));
      filled.cycles.back().first = drawn(cycle->tour).vertices;
    }
    optimise(cycle->tour, part, asked, work);
    filled.curve = drawn(cycle->tour);
    filled.split_and_reconnect = cycle->split_and_reconnect;
    filled.doubled_edges = cycle->doubled_edges;
    for (CycleStages& stages : filled.cycles) stages.optimised = filled.curve.vertices;
    if (sound(filled.curve, part.region, work.width())) return filled;
  }
  return std::nullopt;
}

std::optional<RegionCurve> unfaired_curve(const FillableRegion& part, IslandWork& work) {
  const double d = work.options.seed_distance.value_or(seed_distance_in_widths * work.width());
  if (area(part.domain) > fewest_cells * std::sqrt(3) / 2 * d * d) {
    if (std::optional<RegionCurve> filled = curve_of_cycle(part, d, work)) return filled;
  }
  const Stopwatch watch(work.plan.graph);
  if (std::optional<Curve> curve = contour(part.region, work.width())) return RegionCurve{std::move(*curve)};
  return std::nullopt;
}

/// What fairing needs to know of a region. Strands of stripes hold the asked directions more firmly.
FairingOptions fairing_options(const FillableRegion& part, bool of_stripes, IslandWork& work) {
  FairingOptions fairing = work.settings.fairing;
  fairing.bead_width = work.width();
  fairing.target_length = area(part.region) / work.width();
  fairing.hold_length = !part.thin;
  fairing.field = &work.demands.field();
  fairing.workers = &work.workers;
  fairing.zones = work.demands.orientation_zones();
  if (of_stripes) {
    fairing.field = &work.demands.named_field();
    fairing.alignment_by_length = true;
    // Strands of stripes do not crowd, and the fingers that reach the ends of thin places are to stay.
    fairing.may_retract = false;
    fairing.coarse_iterations = work.settings.stripe_coarse_iterations;
    fairing.fine_iterations = work.settings.stripe_fine_iterations;
    fairing.coarse_samples_per_width = fairing.samples_per_width;
    fairing.alignment = work.settings.stripe_alignment;
    fairing.fine_alignment = work.settings.stripe_fine_alignment;
    fairing.likeness = work.settings.stripe_likeness;
  }
  fairing.may_continue = work.budget.stage(kept_for_fairing);
  return fairing;
}

double farthest(const Curve& curve, const FillableRegion& part, IslandWork& work) {
  return look_for_holes(curve, part.region, work.width(), &work.workers).farthest / work.width();
}

/// Fairs the curve. The result is discarded if it is not sound, which only rounding can cause. Strands that
/// are held straight may leave a hole where their number does not fit the width; then the curve is faired
/// again without directions.
void fair_curve(RegionCurve& filled, const FillableRegion& part, IslandWork& work) {
  const Stopwatch watch(work.plan.fairing);
  const double w = work.width();
  FairingOptions fairing = fairing_options(part, false, work);
  Curve result = fair(smoothed(filled.curve, part.region, w, &work.workers), part.region, fairing).curve;
  if (!work.demands.field().empty() && farthest(result, part, work) > nearly_far) {
    fairing.field = nullptr;
    fairing.may_continue = work.budget.stage();
    result = fair(result, part.region, fairing).curve;
  }
  filled.faired = sound(result, part.region, w);
  if (filled.faired) filled.curve = std::move(result);
}

/// A faired curve of strands along the asked directions, where the whole region asks for them, time is left,
/// and no hole remains.
std::optional<RegionCurve> curve_of_stripes(const FillableRegion& part, IslandWork& work) {
  if (!work.settings.stripes || part.thin || !work.demands.wholly_aligned(part.region)) return std::nullopt;
  const double w = work.width();
  std::optional<StripeCurve> laid;
  {
    const Stopwatch watch(work.plan.cycle);
    const MayContinue may_continue = work.budget.stage();
    if (!may_continue()) return std::nullopt;
    laid = stripe_curve(part.region, work.demands.field(), {w, work.options.seed, may_continue});
  }
  if (!laid) return std::nullopt;
  const Stopwatch watch(work.plan.fairing);
  RegionCurve filled;
  if (work.options.stages != nullptr) filled.cycles.push_back(drawn(*laid));
  filled.curve = fair(smoothed(laid->curve, part.region, w, &work.workers), part.region,
                      fairing_options(part, true, work))
                     .curve;
  filled.faired = true;
  if (!sound(filled.curve, part.region, w) || farthest(filled.curve, part, work) > nearly_far ||
      bare_area(filled.curve, part.region, w) > most_bare * w * w + bare_share * area(part.region))
    return std::nullopt;
  return filled;
}

std::optional<RegionCurve> faired_curve(const FillableRegion& part, IslandWork& work);

/// Adds the figures of a part to those of the whole.
void add_figures(RegionCurve& sum, RegionCurve& part) {
  sum.split_and_reconnect += part.split_and_reconnect;
  sum.doubled_edges += part.doubled_edges;
  std::move(part.cycles.begin(), part.cycles.end(), std::back_inserter(sum.cycles));
}

/// Fills each piece with a curve of its own, and joins them.
std::optional<RegionCurve> fill_pieces(const std::vector<Polygon>& pieces, const FillableRegion& part,
                                       IslandWork& work) {
  const double w = work.width();
  if (pieces.size() < 2 || pieces.size() > most_pieces) return std::nullopt;
  RegionCurve sum;
  std::vector<Curve> curves;
  for (const Polygon& piece : pieces) {
    const Fillable parts = fillable(piece, w, half_width(work.options));
    if (parts.too_thin > most_thin * area(piece) || parts.regions.size() != 1) return std::nullopt;
    std::optional<RegionCurve> filled = faired_curve(parts.regions.front(), work);
    if (!filled || !filled->faired) return std::nullopt;
    add_figures(sum, *filled);
    curves.push_back(std::move(filled->curve));
  }
  const Stopwatch watch(work.plan.fairing);
  std::optional<Curve> one = joined(std::move(curves), part.region, w);
  if (!one || !sound(*one, part.region, w)) return std::nullopt;
  sum.curve = std::move(*one);
  sum.faired = true;
  return sum;
}

/// The pieces of a region that ask for directions, and those that do not. Empty if a piece is too small to be
/// worth a joint.
std::vector<Polygon> pattern_pieces(const Polygon& region, const IslandWork& work) {
  Region asking;
  for (const ZoneRegion& zone : work.island.zones) {
    const PatternKind kind = work.zones[zone.zone].pattern.kind;
    if (kind != PatternKind::none && kind != PatternKind::isotropic) asking = unite(asking, zone.polygons);
  }
  const double w = work.width();
  Region pieces = intersect({region}, asking);
  const Region rest = subtract({region}, asking);
  pieces.insert(pieces.end(), rest.begin(), rest.end());
  std::erase_if(pieces, [&](const Polygon& piece) { return area(piece) < speck * w * w; });
  const bool small = std::any_of(pieces.begin(), pieces.end(),
                                 [&](const Polygon& piece) { return area(piece) < least_piece * w * w; });
  return small ? Region{} : pieces;
}

/// A curve through one region, faired if that is possible: of stripes where directions are asked for, of a
/// cell graph elsewhere.
std::optional<RegionCurve> faired_curve(const FillableRegion& part, IslandWork& work) {
  if (std::optional<RegionCurve> filled = curve_of_stripes(part, work)) return filled;
  if (work.settings.stripes && work.demands.partly_aligned(part.region)) {
    if (std::optional<RegionCurve> filled = fill_pieces(pattern_pieces(part.region, work), part, work))
      return filled;
  }
  std::optional<RegionCurve> filled = unfaired_curve(part, work);
  if (filled) fair_curve(*filled, part, work);
  return filled;
}

/// The pieces of the island that hold one material each. Specks are left out: beads of other materials cover
/// them.
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

/// One curve that crosses between materials as rarely as possible. Returns nullopt if a piece is too thin for
/// a curve of its own or cannot be joined to the others.
std::optional<RegionCurve> fill_by_material(const FillableRegion& part, IslandWork& work) {
  return fill_pieces(material_pieces(work.island, work.zones, work.width()), part, work);
}

/// Contours and fill in one curve. `pieces` are the parts of one material each; a single piece stands for the
/// whole.
std::optional<RegionCurve> fill_with_perimeters(const FillableRegion& part,
                                                const std::vector<Polygon>& pieces, int count,
                                                IslandWork& work) {
  RegionCurve sum;
  const FillFunction fill = [&](const FillableRegion& region) -> std::optional<Curve> {
    const FillThick none = [](const FillableRegion&) -> std::optional<RegionCurve> { return std::nullopt; };
    if (std::optional<RegionCurve> thin = fill_thin(region.region, work, none)) {
      if (thin->one_way.empty()) return std::move(thin->curve);
    }
    std::optional<RegionCurve> filled = faired_curve(region, work);
    if (!filled || !filled->faired) return std::nullopt;
    add_figures(sum, *filled);
    return std::move(filled->curve);
  };
  std::optional<Outlined> one =
      with_perimeters(part.region, pieces, {count, work.width(), half_width(work.options)}, fill);
  if (!one || !sound(one->curve, part.region, work.width())) return std::nullopt;
  sum.curve = std::move(one->curve);
  sum.faired = true;
  sum.perimeters = one->perimeters;
  return sum;
}

/// As many contours as possible: by material, else around all materials, else half as many, and so on.
/// Returns nullopt if no contour fits.
std::optional<RegionCurve> fill_with_perimeters(const FillableRegion& part, bool by_material,
                                                IslandWork& work) {
  const std::vector<Polygon> pieces =
      by_material ? material_pieces(work.island, work.zones, work.width()) : std::vector<Polygon>{};
  for (int count = work.options.perimeters; count > 0; count /= 2) {
    if (pieces.size() > 1 && pieces.size() <= most_pieces) {
      if (std::optional<RegionCurve> found = fill_with_perimeters(part, pieces, count, work)) return found;
    }
    if (std::optional<RegionCurve> found = fill_with_perimeters(part, {part.region}, count, work))
      return found;
  }
  return std::nullopt;
}

/// A region without thin places.
std::optional<RegionCurve> fill_thick(const FillableRegion& part, bool by_material, IslandWork& work) {
  by_material = by_material && work.island.zones.size() > 1;
  if (std::optional<RegionCurve> found = fill_with_perimeters(part, by_material, work)) return found;
  if (by_material) {
    if (std::optional<RegionCurve> found = fill_by_material(part, work)) return found;
  }
  return faired_curve(part, work);
}

}  // namespace

std::optional<RegionCurve> fill_region(const FillableRegion& part, bool by_material, IslandWork& work) {
  // Curves of several materials are joined at their borders, which strands along thin places would cut off.
  const bool several = by_material && material_pieces(work.island, work.zones, work.width()).size() > 1;
  const FillThick fill = [&](const FillableRegion& place) -> std::optional<RegionCurve> {
    if (several) return std::nullopt;
    return fill_thick(place, by_material, work);
  };
  const Random random = work.random;
  std::optional<RegionCurve> thin = fill_thin(part.region, work, fill);
  const double w = work.width(), left = thin ? bare_area(thin->curve, part.region, w) : 0;
  if (thin && left <= most_bare * w * w + bare_share * area(part.region)) return thin;
  work.random = random;
  std::optional<RegionCurve> thick = fill_thick(part, by_material, work);
  // Thin places without a strand are no better than curves that do not reach into them.
  if (thin && (!thick || left <= bare_area(thick->curve, part.region, w))) return thin;
  return thick;
}

}  // namespace unicursal::core
