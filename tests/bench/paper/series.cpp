#include "tests/bench/paper/series.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/curve/fairing.hpp"
#include "core/cycle/first_cycle.hpp"
#include "core/cycle/shuffle.hpp"
#include "core/geometry/region.hpp"
#include "core/graph/cell_graph.hpp"
#include "core/graph/matching.hpp"
#include "core/numeric/disjoint_sets.hpp"
#include "core/planner/plan_island.hpp"
#include "tests/bench/paper/methods.hpp"
#include "tests/core/support/shapes.hpp"

namespace unicursal::bench {
namespace {

using core::Polygon;

constexpr double shape_radius = 18;   ///< mm
constexpr double d_in_widths = 2.05;  ///< the planner's default
constexpr double first_d_in_widths = 1.7;
constexpr int short_sweeps = 20;  ///< the spacing hardly depends on how well a cycle is optimised
constexpr double few_turns = 0.99;

/// Where the graph is built: half a strand inside the island, as tests/bench/spacing.cpp does it.
std::optional<Polygon> domain_of(const Polygon& island, double w) {
  const core::Region domain = core::offset(core::offset({island}, -0.25 * w, 0.005 * w), 0.19 * w, 0.005 * w);
  if (domain.empty()) return std::nullopt;
  return *std::max_element(domain.begin(), domain.end(),
                           [](const Polygon& a, const Polygon& b) { return core::area(a) < core::area(b); });
}

std::optional<core::CellGraph> graph_of(const Polygon& island, double d, double w, core::Random& random) {
  const std::optional<Polygon> domain = domain_of(island, w);
  if (!domain) return std::nullopt;
  return core::make_cell_graph(*domain, d, random);
}

core::Demand even(const core::Vec2&) {
  core::Demand demand;
  demand.even_zone = core::EvenZoneIndex(0);
  return demand;
}

core::Demand aligned(const core::Vec2&) {
  core::Demand demand;
  demand.direction = core::doubled(0.4);
  return demand;
}

/// Joins the cycles of a cubic graph without centres: a face whose sides are used in turns, each in another
/// cycle, is turned over (split-and-reconnect); the cycles that are left are joined by doubled edges.
void join_without_refinement(const core::CellGraph& graph, Joining& joining) {
  core::Per<core::EdgeIndex, core::EdgeEnds> ends;
  for (const core::EdgeIndex e : graph.edges()) {
    const core::HalfEdgeIndex h = core::PlanarGraph::forward(e);
    ends.push_back({graph.origin(h), graph.target(h)});
  }
  core::Per<core::EdgeIndex, bool> matched = core::perfect_matching(graph.node_count(), ends);
  if (matched.empty()) return;
  core::DisjointSets cycles(graph.node_count());
  std::size_t left = graph.node_count();
  for (const core::EdgeIndex e : graph.edges()) {
    if (!matched[e] && cycles.join(ends[e].first.number(), ends[e].second.number())) --left;
  }
  for (bool changed = true; changed;) {
    changed = false;
    for (const core::HalfEdgeIndex start : graph.face_start) {
      std::vector<core::EdgeIndex> sides;
      std::vector<std::size_t> met;
      bool in_turns = true;
      core::HalfEdgeIndex h = start;
      do {
        const core::EdgeIndex e = core::PlanarGraph::edge(h);
        const core::EdgeIndex next = core::PlanarGraph::edge(graph.next(h));
        in_turns = in_turns && matched[e] != matched[next];
        sides.push_back(e);
        if (!matched[e]) met.push_back(cycles.find(ends[e].first.number()));
        h = graph.next(h);
      } while (h != start);
      std::sort(met.begin(), met.end());
      if (!in_turns || met.size() < 2 || std::adjacent_find(met.begin(), met.end()) != met.end()) continue;
      for (const core::EdgeIndex e : sides) matched[e] = !matched[e];
      for (const std::size_t cycle : met) cycles.join(met.front(), cycle);
      joining.plain_reconnected += met.size() - 1;
      left -= met.size() - 1;
      changed = true;
    }
  }
  joining.plain_doubled += left - 1;
}

double sharp_turn(const core::Curve& curve) {
  std::vector<double> turns;
  for (std::size_t i = 0; i < curve.size(); ++i) {
    const core::Vec2 in = curve.vertices[i] - curve.vertices[curve.before(i)];
    const core::Vec2 out = curve.vertices[curve.after(i)] - curve.vertices[i];
    turns.push_back(std::abs(std::atan2(core::cross(in, out), in.dot(out))));
  }
  const auto nth = static_cast<std::ptrdiff_t>(few_turns * static_cast<double>(turns.size()));
  std::nth_element(turns.begin(), turns.begin() + nth, turns.end());
  return turns[static_cast<std::size_t>(nth)];
}

}  // namespace

std::vector<Polygon> shapes(std::size_t count) {
  std::vector<Polygon> result;
  for (std::size_t k = 0; k < count; ++k) {
    core::Random random(100 + k);
    result.push_back(core::test::random_island(random, shape_radius, 3));
  }
  return result;
}

SpacingAgainstD spacing_at(double d, const std::vector<Polygon>& shapes) {
  SpacingAgainstD result{d, 0, 1e300, 0};
  std::size_t counted = 0;
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    core::Random random(k);
    const double w = d / first_d_in_widths;
    const auto graph = graph_of(shapes[k], d, w, random);
    auto cycle = graph ? core::first_cycle(*graph) : std::nullopt;
    if (!cycle) continue;
    core::ShuffleOptions options;
    options.sweeps = short_sweeps;
    core::shuffle(cycle->tour, k % 2 == 0 ? even : aligned, {}, options, random);
    const double spacing =
        core::area(shapes[k]) / core::smoothed(core::drawn(cycle->tour), shapes[k], w).length();
    result.mean += spacing;
    result.least = std::min(result.least, spacing);
    result.most = std::max(result.most, spacing);
    ++counted;
  }
  result.mean /= static_cast<double>(std::max<std::size_t>(counted, 1));
  return result;
}

HeldSpacing held_spacing(double bead_width, const std::vector<Polygon>& shapes) {
  HeldSpacing result{1e300, 0, 0, 0};
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    core::PlanOptions options;
    options.bead_width = bead_width;
    options.min_bead_width = 0.55 * bead_width;
    options.seed = k;
    const core::IslandPlan plan =
        core::plan_island(core::test::whole(shapes[k]), core::test::one_zone(), options);
    double area = 0, length = 0;
    for (const core::PlannedCurve& curve : plan.curves) {
      area += curve.path.total_area();
      length += curve.path.total_length();
      result.worst_variation = std::max(result.worst_variation, curve.objectives.width_variation);
    }
    if (!(length > 0)) {
      ++result.failed;
      continue;
    }
    result.least = std::min(result.least, area / length / bead_width);
    result.most = std::max(result.most, area / length / bead_width);
  }
  return result;
}

CostAtD cost_at(double d, const Polygon& shape) {
  CostAtD cost;
  cost.d = d;
  const double w = d / d_in_widths;
  core::Random random(1);
  double start = processor_seconds();
  const auto graph = graph_of(shape, d, w, random);
  auto cycle = graph ? core::first_cycle(*graph) : std::nullopt;
  if (!cycle) return cost;
  cost.graph = processor_seconds() - start;
  cost.nodes = cycle->nodes;
  core::ShuffleOptions options;
  options.rule = core::ShuffleOptions::Rule::algorithm_1;
  options.at_flaws = 0;
  options.sweeps = 16;  // ShuffleIter + ImproveIter, in N
  start = processor_seconds();
  core::shuffle(cycle->tour, even, {}, options, random);
  cost.shuffle = processor_seconds() - start;
  core::FairingOptions fairing;
  fairing.bead_width = w;
  fairing.target_length = core::area(shape) / w;
  const core::Curve smooth = core::smoothed(core::drawn(cycle->tour), shape, w);
  start = processor_seconds();
  cost.fairing_steps = core::fair(smooth, shape, fairing).iterations;
  cost.fairing_step = (processor_seconds() - start) / std::max(cost.fairing_steps, 1);
  return cost;
}

double exponent(const std::vector<CostAtD>& costs, double CostAtD::*time) {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (const CostAtD& cost : costs) {
    if (cost.nodes == 0 || !(cost.*time > 0)) continue;
    const double a = std::log(static_cast<double>(cost.nodes)), b = std::log(cost.*time);
    n += 1, x += a, y += b, xx += a * a, xy += a * b;
  }
  return (n * xy - x * y) / (n * xx - x * x);
}

Joining joining_of(const Part& part) {
  Joining joining;
  for (const core::Island& island : part.layer.islands) {
    core::Random random(1);
    const double d = part.plan.seed_distance.value_or(d_in_widths * part.width());
    const auto graph = graph_of(island.outline, d, part.width(), random);
    const auto cycle = graph ? core::first_cycle(*graph) : std::nullopt;
    if (!cycle) continue;
    joining.reconnected += cycle->split_and_reconnect;
    joining.doubled += cycle->doubled_edges;
    join_without_refinement(*graph, joining);
  }
  return joining;
}

double doubled_share(std::size_t reconnected, std::size_t doubled) {
  const auto all = static_cast<double>(reconnected + doubled);
  return all > 0 ? static_cast<double>(doubled) / all : 0;
}

Smoothing smoothing_of(const Part& part) {
  Smoothing result;
  result.with.method = "smooth";
  result.without.method = "unsmooth";
  const double w = part.width();
  for (const core::Island& island : part.layer.islands) {
    core::Random random(1);
    const auto graph = graph_of(island.outline, d_in_widths * w, w, random);
    auto cycle = graph ? core::first_cycle(*graph) : std::nullopt;
    result.with.islands.emplace_back();
    result.without.islands.emplace_back();
    if (!cycle) continue;
    core::shuffle(cycle->tour, even, {}, core::ShuffleOptions(), random);
    const core::Curve start = core::smoothed(core::drawn(cycle->tour), island.outline, w);
    core::FairingOptions options;
    options.bead_width = w;
    options.target_length = core::area(island.outline) / w;
    const core::Curve with = core::fair(start, island.outline, options).curve;
    options.smoothness = 0;
    const core::Curve without = core::fair(start, island.outline, options).curve;
    result.sharpest_with = std::max(result.sharpest_with, sharp_turn(with));
    result.sharpest_without = std::max(result.sharpest_without, sharp_turn(without));
    result.with.islands.back().lines.push_back({with.vertices, true});
    result.without.islands.back().lines.push_back({without.vertices, true});
  }
  return result;
}

}  // namespace unicursal::bench
