// The coverage objective (paper (7), Appendix A "CVT objective") on a sampling lattice: the integral over the
// island of the squared distance to the curve, mm⁴, and its gradient per vertex, mm³.
//
// Departure from the paper: the diagram of segments is sampled, not constructed. Each sample pulls the two
// ends of its nearest segment, as (15), (21) and (22) do in the limit. A square that is cut by the border
// between two cells is divided among them in proportion, which makes five squares per bead width as good as
// twelve squares with one owner each. The gradient is that of the continuous objective; it differs from that
// of the sampled value by terms of second order in the size of a square (tests compare it with differences).
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

  /// The samples' owners in the last evaluate(); segment i leaves vertex i.
  const LatticeOwners& owners() const { return owners_; }

  /// The area that each segment was nearest to in the last evaluate(), mm².
  std::vector<double> areas() const;

 private:
  const Lattice& lattice_;
  LatticeOwners owners_;
};

}  // namespace unicursal::core
