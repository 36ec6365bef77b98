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

  /// All directions, with those that anisotropic zones have chosen.
  const DirectionField& field() const { return field_; }
  /// The same without anisotropic zones, which ask their strands to be alike instead.
  const DirectionField& named_field() const { return named_field_ ? *named_field_ : field_; }
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
  /// Whether all of the piece, except for little, is to be aligned.
  bool wholly_aligned(const Polygon& piece) const;
  /// Whether some of the piece is to be aligned, and some not.
  bool partly_aligned(const Polygon& piece) const;
  /// The direction, rad, that nearly all of the piece is to follow; nullopt if directions differ.
  std::optional<double> one_direction(const Polygon& piece) const;

 private:
  Vec2 mean_direction(const Polygon& piece, double& aligned_share) const;
  int material_borders(const Vec2& a, const Vec2& b) const;

  const std::vector<Zone>& zones_;
  double bead_width_;
  DirectionField field_;
  std::optional<DirectionField> named_field_;  ///< absent if it is the same as field_
  ZoneMap map_;
  bool several_materials_ = false;
};

/// The direction, rad, in which strands end at the zone's borders least often: of n strands a mm side by
/// side, n |sin α| ds end along a border of length ds at an angle α to them.
double direction_of_fewest_ends(const ZoneRegion& region);

}  // namespace unicursal::core
