// What the stages of one island share, and what they hand on.
#pragma once

#include <cstddef>
#include <vector>

#include "core/numeric/parallel.hpp"
#include "core/numeric/random.hpp"
#include "core/numeric/step_budget.hpp"
#include "core/planner/demands.hpp"
#include "core/planner/fillable.hpp"
#include "core/planner/island_plan.hpp"
#include "core/planner/preset.hpp"
#include "core/planner/stages.hpp"
#include "core/thin/strands.hpp"

namespace unicursal::core {

/// What all stages of one island share.
struct IslandWork {
  const Island& island;
  const std::vector<Zone>& zones;
  const PlanOptions& options;
  const Demands& demands;
  Settings settings;
  Random random;
  StepBudget budget;
  IslandPlan plan;  ///< receives times and figures
  Workers workers;

  double width() const { return options.bead_width; }
};

/// A closed curve that fills a region, and how it was made.
struct RegionCurve {
  Curve curve;
  std::size_t split_and_reconnect = 0, doubled_edges = 0;
  bool faired = false;
  int perimeters = 0;                    ///< contours laid
  std::vector<CycleStages> cycles = {};  ///< earlier stages of the curve, if the options ask for them
  std::vector<OneWay> one_way = {};      ///< where two strands lie on each other and one of them lays all
};

/// Half the least width that can be laid, mm.
double half_width(const PlanOptions& options);

/// Whether the curve has at least 5 vertices, is simple, and lies inside the region.
bool sound(const Curve& curve, const Polygon& region, double bead_width);

}  // namespace unicursal::core
