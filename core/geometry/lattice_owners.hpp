// Finds the nearest segment of each sample of a lattice: the segment Voronoi diagram for the inner loops of
// the optimisers. Exact up to float rounding, for any distance of the segments.
//
// Every block of samples keeps a list of the segments that may be nearest to one of its samples. As with the
// neighbour lists of molecular dynamics, lists remain valid until an end point has moved by more than
// `slack`. So most calls only test about ten segments per block of eight samples.
//
// Sums over the samples may split squares: a square that is cut by the border between two cells is shared by
// both, in proportion. Five squares per bead width are then as good as twelve that have one owner each.
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
  double slack = 0;    ///< how far end points may move before lists are rebuilt, mm; 0 if moves are not small
  bool split = false;  ///< split squares; the segments must then be those of a closed curve, in order
  Workers* workers = nullptr;  ///< share the work; any number gives the same result. Null: none
};

/// Sums over the samples nearest to one segment a + t (b − a), t in [0, 1]. For a sample p of weight m, `off`
/// is the nearest point minus p. A split square counts for each of its two segments by its share.
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
  /// Squared distance of a sample from its owner, mm². Precondition: it has one.
  double distance2(std::size_t sample) const;

  /// Σ m distance² over all samples, mm⁴; with split squares, each part counts for its own segment.
  double second_moment() const { return second_moment_; }
  /// Per segment.
  const std::vector<SegmentPull>& pulls() const { return pulls_; }

  /// Per segment: the sum of `values` (one per sample) over the samples that it owns.
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
  std::vector<Segment> listed_;         ///< segments when the lists were made
  std::vector<Segment> current_;        ///< segments as last assigned
  std::vector<NearLists> lists_;        ///< per tile
  std::vector<std::size_t> first_sum_;  ///< per tile: where the sums of its segments begin in tile_sums_
  /// Per segment: the indices of its sums in tile_sums_, in order of tiles.
  std::vector<std::uint32_t> sum_start_, sum_of_;
  std::vector<std::array<float, 4>> tile_sums_;  ///< pulls, per tile and segment
  std::vector<double> tile_moments_;
  std::vector<std::int32_t> owner_;  ///< per sample: index among the segments of its tile
  std::vector<SegmentPull> pulls_;
  double second_moment_ = 0;
};

}  // namespace unicursal::core
