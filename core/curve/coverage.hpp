// The coverage objective (paper (7), Appendix A "CVT objective") on a sampling lattice: the integral over the
// island of the squared distance to the curve, mm⁴, and its gradient per vertex, mm³.
//
// Departure from the paper: the diagram of segments is sampled, not constructed; each sample pulls the two
// ends of its nearest segment as (15), (21) and (22) do in the limit. A square that the border between two
// cells cuts is shared by both, in proportion, which makes five squares per bead width as good as twelve
// that have one owner each. The gradient is that of the continuous objective; against the sampled value it is
// right but for terms of second order in the size of a square (tests hold it against differences).
#pragma once

#include <vector>

#include "core/curve/curve.hpp"
#include "core/geometry/lattice.hpp"
#include "core/geometry/lattice_owners.hpp"

namespace unicursal::core {

class Coverage {
 public:
  /// Keeps references to the lattice and the workers. `slack` mm: see lattice_owners.hpp.
  explicit Coverage(const Lattice& lattice, double slack = 0, Workers* workers = nullptr);

  /// Returns the value and adds its gradient, times `weight`, to `gradient` (one entry per vertex).
  double evaluate(const Curve& curve, double weight, std::vector<Vec2>& gradient);

  /// Owners as of the last evaluate(): segment i leaves vertex i.
  const LatticeOwners& owners() const { return owners_; }

  /// mm² that each segment was nearest to then.
  std::vector<double> areas() const;

 private:
  const Lattice& lattice_;
  LatticeOwners owners_;
};

}  // namespace unicursal::core
