// Which segment is nearest to each sample of a lattice: the segment Voronoi diagram in the optimisers' inner
// loops. Every segment writes its squared distance into the samples around it and the nearest wins
// (ties go to the lower index), so one pass costs a few nanoseconds per segment and sample.
#pragma once

#include <cstdint>
#include <vector>

#include "core/geometry/lattice.hpp"

namespace unicursal::core {

struct Segment {
  Vec2 a{0, 0}, b{0, 0};  ///< equal for a point
};

class LatticeOwners {
 public:
  /// Keeps a reference to the lattice.
  explicit LatticeOwners(const Lattice& lattice);

  /// Finds the nearest segment of every sample with weight. Exact up to float rounding within `reach` mm of
  /// the segments; samples farther away inherit the best of their neighbours' owners.
  /// Precondition: at least one segment within reach of one sample, else owners stay −1.
  void assign(const std::vector<Segment>& segments, double reach);

  /// Index of the nearest segment, −1 for samples without weight or when nothing was in reach.
  std::int32_t owner(std::size_t sample) const { return owner_[sample]; }
  /// mm², in float precision.
  float distance2(std::size_t sample) const { return distance2_[sample]; }

 private:
  void splat(const Segment& segment, std::int32_t index, double reach);
  void propagate(const std::vector<Segment>& segments);

  const Lattice& lattice_;
  std::vector<float> distance2_;
  std::vector<std::int32_t> owner_;
};

}  // namespace unicursal::core
