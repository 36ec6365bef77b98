// An island in, closed bead paths out: the stages of the paper's Figure 2 in a row.
#pragma once

#include <memory>
#include <vector>

#include "core/model/part.hpp"
#include "core/planner/island_plan.hpp"

namespace unicursal::core {

/// Plans the islands of one part. Direction files of its zones are read once.
class IslandPlanner {
 public:
  /// Throws FileError or ModelError for a direction file that cannot be used.
  explicit IslandPlanner(std::vector<Zone> zones);

  /// Never throws for a valid island, however small or odd; `unfilled_area` holds the part that cannot be
  /// filled. `z` mm is the height of the cut. Deterministic for equal arguments; may be called from several
  /// threads.
  IslandPlan plan(const Island& island, double z, const PlanOptions& options) const;
  /// Whether any part of the island is wide enough for a curve; much quicker than planning it.
  bool fits(const Island& island, const PlanOptions& options) const;

 private:
  struct Directions;
  std::vector<Zone> zones_;
  std::shared_ptr<const Directions> directions_;
};

/// Plans a single island at z = 0.
IslandPlan plan_island(const Island& island, const std::vector<Zone>& zones, const PlanOptions& options);

}  // namespace unicursal::core
