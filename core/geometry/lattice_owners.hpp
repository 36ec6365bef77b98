// Which segment is nearest to each sample of a lattice: the segment Voronoi diagram in the optimisers' inner
// loops. Exact up to float rounding, however far the segments are.
//
// Every block of samples keeps a list of the segments that may be nearest to one of its samples. Lists stay
// good until a point has moved by more than `slack` (as the neighbour lists of molecular dynamics do), so
// most calls test about ten segments per block of eight samples and look for nothing.
//
// Sums over the samples may split squares: one that the border between two cells cuts is shared by both, in
// proportion, which makes five squares per bead width as good as twelve that have one owner each.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/geometry/lattice.hpp"
#include "core/geometry/near_lists.hpp"
#include "core/geometry/segment.hpp"
#include "core/numeric/parallel.hpp"

namespace unicursal::core {

struct OwnerOptions {
  double slack = 0;            ///< mm; 0 where segments do not move by little
  bool split = false;          ///< share squares; then segments are those of a closed curve, in its order
  Workers* workers = nullptr;  ///< that share the work; the result is the same for any number of them
};

/// What the samples nearest to one segment a + t (b − a), t in [0, 1], add up to. Per sample p of weight m,
/// off = nearest point − p. Split squares count for either segment by their share.
struct SegmentPull {
  Vec2 all{0, 0};  ///< Σ m off, mm³
  Vec2 end{0, 0};  ///< Σ m t off, mm³
};

class LatticeOwners {
 public:
  /// Keeps references to the lattice and the workers.
  explicit LatticeOwners(const Lattice& lattice, const OwnerOptions& options = {});

  /// Finds the nearest segment of every sample with weight.
  void assign(std::vector<Segment> segments);

  /// Index of the nearest segment; −1 for samples without weight, or if there are no segments.
  std::int32_t owner(std::size_t sample) const;
  /// mm². Precondition: the sample has an owner.
  double distance2(std::size_t sample) const;

  /// Σ m distance² over all samples, mm⁴; where squares are split, of what each segment has of them.
  double second_moment() const { return second_moment_; }
  /// Per segment.
  const std::vector<SegmentPull>& pulls() const { return pulls_; }

  /// Per segment, the sum of `values`, one per sample, over the samples that it owns.
  std::vector<Vec2> sums(const std::vector<std::array<float, 2>>& values) const;

 private:
  bool lists_hold(const std::vector<Segment>& segments) const;
  void make_lists();
  void number_sums();
  void scan(std::size_t tile);
  template <typename Add>
  void gather(Add add) const;

  const Lattice& lattice_;
  double slack_;
  bool split_;
  mutable Workers serial_{1};
  Workers& workers_;
  std::vector<Segment> listed_;                    ///< as they were when the lists were made
  std::vector<Segment> current_;                   ///< as last assigned
  std::vector<NearLists> lists_;                   ///< per tile
  std::vector<std::size_t> first_sum_;             ///< per tile: its segments' sums among all tiles'
  std::vector<std::uint32_t> sum_start_, sum_of_;  ///< per segment: its sums, in order of tiles
  std::vector<std::array<float, 4>> tile_sums_;    ///< pulls
  std::vector<double> tile_moments_;
  std::vector<std::int32_t> owner_;  ///< per sample, among its tile's segments
  std::vector<SegmentPull> pulls_;
  double second_moment_ = 0;
};

}  // namespace unicursal::core
