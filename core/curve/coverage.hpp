// The coverage objective (paper (7), Appendix A "CVT objective") on a sampling lattice: the integral over the
// island of the squared distance to the curve, mm⁴, and its gradient per vertex, mm³.
//
// Departure from the paper: the diagram of segments is sampled, not constructed; each sample pulls the two
// ends of its nearest segment as (15), (21) and (22) do in the limit. A square that the border between two
// cells cuts is shared by both, in proportion, which makes five squares per bead width as good as twelve
// that have one owner each. The gradient is that of the continuous objective; against the sampled value it is
// right but for terms of second order in the size of a square (tests hold it against differences).
#pragma once

#include <optional>
#include <vector>

#include "core/curve/curve.hpp"
#include "core/geometry/lattice.hpp"
#include "core/geometry/lattice_owners.hpp"

namespace unicursal::core {

class Coverage {
 public:
  /// Keeps a reference to the lattice. `reach` mm: beyond it owners are approximate (lattice_owners.hpp).
  Coverage(const Lattice& lattice, double reach);

  /// Returns the value and adds its gradient, times `weight`, to `gradient` (one entry per vertex).
  double evaluate(const Curve& curve, double weight, std::vector<Vec2>& gradient);

  /// Owners as of the last evaluate(): segment i leaves vertex i.
  const LatticeOwners& owners() const { return owners_; }

 private:
  /// Where a sample's perpendicular meets a segment.
  struct Foot {
    std::size_t segment = 0;
    double along = 0;  ///< 0 at the segment's start, 1 at its end
    Vec2 off{0, 0};    ///< from the sample to the foot, mm
  };
  Foot foot_on(const Vec2& p, std::size_t segment) const;
  std::optional<Foot> competitor(std::size_t k, const Vec2& p, const Foot& own) const;
  /// What of a square belongs to the other segment, and by how much that lowers the mean squared distance.
  struct Split {
    double share = 0, gain = 0;  ///< 0 to ½; mm²
  };
  Split split_between(const Foot& own, const Foot& other) const;

  const Lattice& lattice_;
  double reach_;
  LatticeOwners owners_;
  std::vector<Segment> segments_;
};

}  // namespace unicursal::core
