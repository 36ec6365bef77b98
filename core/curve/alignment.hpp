// The alignment objective (paper (32) to (36)): how well the curve follows a field of directions, rad² mm².
//
// Departures from the paper: a segment takes in all samples that are nearest to it, its ends included,
// instead of ends having cells of their own; Z (35) is left at its limit 1 for cells within which the field
// hardly turns. As in the paper the gradient ignores that cells change with the curve (tests hold it against
// differences with cells kept).
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
  /// Asks for nothing.
  Alignment() = default;
  /// The field is looked up at each sample, turned back by `turn` rad (lattice and curve are turned by it).
  Alignment(const Lattice& lattice, const DirectionField& field, double turn);

  bool empty() const { return values_.empty(); }

  /// Value, with `weight` times its gradient added. `owners` are the samples' nearest segments; segment i
  /// leaves vertex i.
  double evaluate(const Curve& curve, const LatticeOwners& owners, double weight,
                  std::vector<Vec2>& gradient) const;

 private:
  std::vector<std::array<float, 2>> values_;  ///< per sample: ∫ V over its piece of the island, mm²
};

/// Mean squared angle between the curve and the field where the field asks for a direction, by length, rad².
/// Every direction alike gives π²/12 = 0.82. Zero when nothing is asked along the curve.
double mean_squared_angle(const Curve& curve, const DirectionField& field);

}  // namespace unicursal::core
