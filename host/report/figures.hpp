// Measurements of curves, of one island or added up over a layer or a print. mm, mm², s.
#pragma once

#include <cstddef>
#include <map>
#include <nlohmann/json_fwd.hpp>

#include "core/planner/island_plan.hpp"
#include "host/lookahead/planned_layer.hpp"

namespace unicursal::host {

struct Figures {
  std::size_t islands = 0;
  std::size_t empty_islands = 0;  ///< too thin for any curve
  std::size_t curves = 0;
  std::size_t vertices = 0;
  double length = 0;                 ///< of the curves
  double area = 0;                   ///< filled by the segments
  core::CurveObjectives objectives;  ///< sums
  std::map<int, std::size_t>
      curves_by_perimeters;  ///< number of contours → number of curves that laid so many
  std::size_t zone_crossings = 0;
  std::size_t self_intersections = 0;
  std::size_t outside_segments = 0;
  std::size_t split_and_reconnect = 0;
  std::size_t doubled_edges = 0;
  double farthest = 0;       ///< the greatest
  double unfilled_area = 0;  ///< too thin for a bead
  double narrow_length = 0;  ///< of bead narrower than the nozzle can lay
  double wide_length = 0;    ///< of bead wider than the nozzle can lay
  double far_area = 0;       ///< farther than 1.2 bead widths from the curve
  core::StageTime graph, cycle, fairing, widths;

  /// mm, area ÷ length; 0 without a curve.
  double mean_spacing() const { return length > 0 ? area / length : 0; }
  /// Coverage ÷ (area × mean spacing²); straight parallel lines give 1/12.
  double normalised_coverage() const;
};

Figures measure(const core::IslandPlan& plan);
Figures measure(const PlannedLayer& layer);
Figures& operator+=(Figures& sum, const Figures& more);

/// The keys are explained in host/report/README.md.
nlohmann::json to_json(const Figures& figures);

}  // namespace unicursal::host
