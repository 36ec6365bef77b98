#include "host/report/figures.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace unicursal::host {
namespace {

void add_to_sum(core::StageTime& sum, const core::StageTime& more) {
  sum.seconds += more.seconds;
  sum.cpu_seconds += more.cpu_seconds;
}

/// Objectives that do not add up.
void worst_of(core::CurveObjectives& sum, const core::CurveObjectives& more) {
  sum.isotropy = std::max(sum.isotropy, more.isotropy);
  sum.anisotropy = std::max(sum.anisotropy, more.anisotropy);
  sum.width_variation = std::max(sum.width_variation, more.width_variation);
}

void add_to_sum(Figures& sum, const core::PlannedCurve& curve) {
  sum.curves += 1;
  sum.vertices += curve.path.size();
  sum.length += curve.path.total_length();
  sum.area += curve.path.total_area();
  sum.objectives.coverage += curve.objectives.coverage;
  sum.objectives.length += curve.objectives.length;
  sum.objectives.smoothness += curve.objectives.smoothness;
  sum.objectives.alignment += curve.objectives.alignment * curve.path.total_length();
  worst_of(sum.objectives, curve.objectives);
  sum.zone_crossings += curve.zone_crossings;
  sum.self_intersections += curve.self_intersections;
  sum.outside_segments += curve.outside_segments;
  ++sum.curves_by_perimeters[curve.perimeters];
  sum.split_and_reconnect += curve.split_and_reconnect;
  sum.doubled_edges += curve.doubled_edges;
  sum.narrow_length += curve.narrow_length;
  sum.wide_length += curve.wide_length;
  sum.farthest = std::max(sum.farthest, curve.farthest);
}

}  // namespace

double Figures::normalised_coverage() const {
  const double w = mean_spacing();
  return area > 0 && w > 0 ? objectives.coverage / (area * w * w) : 0;
}

Figures measure(const core::IslandPlan& plan) {
  Figures figures;
  figures.islands = 1;
  figures.empty_islands = plan.curves.empty() ? 1 : 0;
  for (const core::PlannedCurve& curve : plan.curves) add_to_sum(figures, curve);
  figures.unfilled_area = plan.unfilled_area;
  figures.far_area = plan.far_area;
  figures.graph = plan.graph;
  figures.cycle = plan.cycle;
  figures.fairing = plan.fairing;
  figures.widths = plan.widths;
  return figures;
}

Figures measure(const PlannedLayer& layer) {
  Figures figures;
  for (const core::IslandPlan& plan : layer.plans) figures += measure(plan);
  return figures;
}

Figures& operator+=(Figures& sum, const Figures& more) {
  sum.islands += more.islands;
  sum.empty_islands += more.empty_islands;
  sum.curves += more.curves;
  sum.vertices += more.vertices;
  sum.length += more.length;
  sum.area += more.area;
  sum.objectives.coverage += more.objectives.coverage;
  sum.objectives.length += more.objectives.length;
  sum.objectives.smoothness += more.objectives.smoothness;
  sum.objectives.alignment += more.objectives.alignment;
  for (const auto& [count, curves] : more.curves_by_perimeters) sum.curves_by_perimeters[count] += curves;
  worst_of(sum.objectives, more.objectives);
  sum.zone_crossings += more.zone_crossings;
  sum.self_intersections += more.self_intersections;
  sum.outside_segments += more.outside_segments;
  sum.split_and_reconnect += more.split_and_reconnect;
  sum.doubled_edges += more.doubled_edges;
  sum.farthest = std::max(sum.farthest, more.farthest);
  sum.narrow_length += more.narrow_length;
  sum.wide_length += more.wide_length;
  sum.unfilled_area += more.unfilled_area;
  sum.far_area += more.far_area;
  add_to_sum(sum.graph, more.graph);
  add_to_sum(sum.cycle, more.cycle);
  add_to_sum(sum.fairing, more.fairing);
  add_to_sum(sum.widths, more.widths);
  return sum;
}

nlohmann::json to_json(const Figures& f) {
  nlohmann::json perimeters = nlohmann::json::object();
  for (const auto& [count, curves] : f.curves_by_perimeters) perimeters[std::to_string(count)] = curves;
  return {
      {"islands", f.islands},
      {"empty_islands", f.empty_islands},
      {"curves", f.curves},
      {"vertices", f.vertices},
      {"area_mm2", f.area},
      {"length_mm", f.length},
      {"mean_spacing_mm", f.mean_spacing()},
      {"farthest_mm", f.farthest},
      {"unfilled_mm2", f.unfilled_area},
      {"far_mm2", f.far_area},
      {"too_narrow_mm", f.narrow_length},
      {"too_wide_mm", f.wide_length},
      {"objectives",
       {{"coverage", f.objectives.coverage},
        {"normalised_coverage", f.normalised_coverage()},
        {"E", f.normalised_coverage()},
        {"length", f.objectives.length},
        {"smoothness", f.objectives.smoothness},
        {"alignment", f.length > 0 ? f.objectives.alignment / f.length : 0.0},
        {"isotropy", f.objectives.isotropy},
        {"anisotropy", f.objectives.anisotropy},
        {"width_variation", f.objectives.width_variation}}},
      {"curves_by_perimeters", perimeters},
      {"zone_crossings", f.zone_crossings},
      {"self_intersections", f.self_intersections},
      {"outside_segments", f.outside_segments},
      {"split_and_reconnect", f.split_and_reconnect},
      {"doubled_edges", f.doubled_edges},
      {"seconds",
       {{"graph", f.graph.seconds},
        {"cycle", f.cycle.seconds},
        {"fairing", f.fairing.seconds},
        {"widths", f.widths.seconds}}},
      {"cpu_seconds",
       {{"graph", f.graph.cpu_seconds},
        {"cycle", f.cycle.cpu_seconds},
        {"fairing", f.fairing.cpu_seconds},
        {"widths", f.widths.cpu_seconds}}},
  };
}

}  // namespace unicursal::host
