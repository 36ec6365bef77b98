// What the zones of one island ask of its curve, in the form that each stage needs. V is the field of asked
// directions, in doubled angle (core/README.md, "Notation").
#pragma once

#include <optional>
#include <vector>

#include "core/curve/fairing.hpp"
#include "core/cycle/cycle_objective.hpp"
#include "core/field/direction_field.hpp"
#include "core/field/make_direction_field.hpp"
#include "core/model/part.hpp"
#include "core/planner/zone_map.hpp"

namespace unicursal::core {

class Demands {
 public:
  /// Keeps references to the island and the zones. `bead_width` mm; `z` mm is the height of the cut.
  Demands(const Island& island, const std::vector<Zone>& zones, const ZoneDirections& files, double z,
          double bead_width);

  const DirectionField& field() const { return field_; }
  const ZoneMap& map() const { return map_; }

  /// For the first cycle: a run along the field earns, a run across it or over a material's border costs.
  RunCost first_run_cost() const;
  /// For the combinatorial optimiser: the cost of an edge, which is zero along the field (33), (55). `weight`
  /// applies to the field.
  RunCost edge_cost(double weight) const;
  /// For the combinatorial optimiser: what is asked at a point.
  DemandAt at() const;
  /// For fairing: the zones with an orientation objective.
  std::vector<OrientationZone> orientation_zones() const;

  /// Whether most of the piece is to be aligned.
  bool mostly_aligned(const Polygon& piece) const;
  /// The direction, rad, that nearly all of the piece is to follow; nullopt if directions differ.
  std::optional<double> one_direction(const Polygon& piece) const;

 private:
  Vec2 mean_direction(const Polygon& piece, double& aligned_share) const;
  int material_borders(const Vec2& a, const Vec2& b) const;

  const std::vector<Zone>& zones_;
  double bead_width_;
  DirectionField field_;
  ZoneMap map_;
  bool several_materials_ = false;
};

/// The direction, rad, in which a zone of an island extends farthest: its principal axis.
double principal_axis(const ZoneRegion& region);

}  // namespace unicursal::core
