// A layer that has been sliced and planned, and figures about planning. s.
#pragma once

#include <cstddef>
#include <vector>

#include "core/model/part.hpp"
#include "core/planner/bare.hpp"
#include "core/planner/island_plan.hpp"

namespace unicursal::host {

struct PlannedLayer {
  core::Layer layer;
  std::vector<core::IslandPlan> plans;  ///< one per island, in the same order
  std::vector<core::Bare> bare;         ///< what they leave without plastic, in the same order
  double cpu_seconds = 0;               ///< processor time of slicing and planning it
  /// The optimisers' steps as a share of those with full effort, weighted by area; 1 if all islands had full
  /// effort.
  double effort = 1;
  double ready_at = 0;  ///< in virtual time: when it would have been ready, s
};

/// Layers that are planned but not yet taken.
struct Waiting {
  std::size_t layers = 0;
  double seconds = 0;  ///< of printing
};

/// What planning has cost so far.
struct PlanningEffort {
  double seconds = 0;      ///< time during which at least one thread was slicing or planning
  double cpu_seconds = 0;  ///< of all threads together
};

}  // namespace unicursal::host
