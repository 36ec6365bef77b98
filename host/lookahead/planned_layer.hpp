// A layer that is sliced and planned, and how many of them wait. s.
#pragma once

#include <cstddef>
#include <vector>

#include "core/model/part.hpp"
#include "core/planner/island_plan.hpp"

namespace unicursal::host {

struct PlannedLayer {
  core::Layer layer;
  std::vector<core::IslandPlan> plans;  ///< one for each island, in the same order
  double cpu_seconds = 0;               ///< that slicing and planning it have cost
  /// Of the optimisers' steps that its islands would have taken had nobody hurried, by area; 1 when none was
  /// cut.
  double effort = 1;
  double ready_at = 0;  ///< s, in virtual time: when it would have been there
};

/// Layers that are planned and not yet taken.
struct Waiting {
  std::size_t layers = 0;
  double seconds = 0;  ///< of printing
};

/// What planning has cost so far.
struct PlanningEffort {
  double seconds = 0;      ///< during which at least one thread was slicing or planning
  double cpu_seconds = 0;  ///< of all threads together
};

}  // namespace unicursal::host
