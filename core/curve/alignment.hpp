// The alignment objective (paper (32) to (36)): how well the curve follows a field of directions V (in
// doubled angle, see core/README.md, "Notation"), rad² mm².
//
// Departures from the paper: all samples that are nearest to a segment or to its ends count for the segment,
// so that ends have no cells of their own; Z (35) is set to 1, its limit for cells in which the field hardly
// turns. As in the paper, the gradient ignores that cells change with the curve (tests compare it with
// differences for fixed cells).
#pragma once

#include <array>
#include <vector>

#include "core/curve/curve.hpp"
#include "core/field/direction_field.hpp"
#include "core/geometry/lattice.hpp"
#include "core/geometry/lattice_owners.hpp"

namespace unicursal::core {

class Alignment {
 public:
  /// An empty objective.
  Alignment() = default;
  /// Lattice and curve are turned by `turn` rad against the field, which is looked up at the samples turned
  /// back.
  Alignment(const Lattice& lattice, const DirectionField& field, double turn);

  bool empty() const { return values_.empty(); }

  /// Returns the value and adds `weight` times its gradient to `gradient`. `owners` holds the samples'
  /// nearest segments; segment i leaves vertex i.
  double evaluate(const Curve& curve, const LatticeOwners& owners, double weight,
                  std::vector<Vec2>& gradient) const;

 private:
  std::vector<std::array<float, 2>> values_;  ///< ∫ V over each sample's piece of the island, mm²
};

/// The field in the middle of each segment, in the frame of a curve that is turned by `turn` rad against it.
/// Vectors that are too short to ask for a direction are zero.
std::vector<Vec2> asked_along(const Curve& curve, const DirectionField& field, double turn);

/// The same objective with the area of each segment's cell taken as its length times `width` mm, and with
/// what asked_along() has found for a curve nearby: the gradient is then exact, so that descent does not
/// stall where the field jumps, and no cell is needed.
double alignment_along(const Curve& curve, const std::vector<Vec2>& asked, double width, double weight,
                       std::vector<Vec2>& gradient);

/// Mean squared angle between the curve and the field, weighted by length, where the field asks for a
/// direction, rad². A curve that ignores the field gives π²/12 = 0.82. Zero if no direction is asked along
/// the curve.
double mean_squared_angle(const Curve& curve, const DirectionField& field);

}  // namespace unicursal::core
