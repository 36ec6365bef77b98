// From a fillable region to a closed curve: the stages of the paper's Figure 2 in a row.
#pragma once

#include <optional>
#include <vector>

#include "core/numeric/parallel.hpp"
#include "core/numeric/random.hpp"
#include "core/numeric/step_budget.hpp"
#include "core/planner/demands.hpp"
#include "core/planner/fillable.hpp"
#include "core/planner/island_plan.hpp"
#include "core/planner/preset.hpp"
#include "core/planner/stages.hpp"

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
};

/// Half the least width that can be laid, mm.
double half_width(const PlanOptions& options);

/// Whether the curve has at least 5 vertices, is simple, and lies inside the region.
bool sound(const Curve& curve, const Polygon& region, double bead_width);

/// One closed curve through the region, with the contours that the options ask for. If `by_material` is true,
/// each material gets its own curve where there is room, and the curves are joined. Returns nullopt if not
/// even a contour fits.
std::optional<RegionCurve> fill_region(const FillableRegion& part, bool by_material, IslandWork& work);

}  // namespace unicursal::core
