// The innermost loops over points and segments: eight at a time as floats relative to a tile of a lattice, or
// four at a time as doubles where exactness matters. On x86 each loop is compiled in two versions, for SSE2
// and for AVX2, one of which is chosen at run time; on 64-bit ARM in one, for NEON, which all these
// processors have. None fuses multiplications and additions, so all give the same bytes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/geometry/lattice.hpp"

namespace unicursal::core {

struct TileSegment {
  float ax, ay, ux, uy;  ///< start, and vector from start to end, mm
  float inverse;         ///< 1 ÷ length²; 0 for a point
};

struct TileScan {
  const Lattice::Block* blocks;
  std::size_t count;
  const Lattice::BorderBlock* borders;
  float pitch;
  const TileSegment* segments;
  const std::uint32_t* start;   ///< per block: where its part of `entries` begins; and the end
  const std::int32_t* entries;  ///< segments to test, block by block
  std::int32_t* owner;          ///< output, per sample; −1 for samples without weight
  std::array<float, 4>* sums;   ///< output, per segment, added to: Σ m off, Σ m t off
  /// Per segment: its place along a closed curve; null: squares are not split.
  const std::int32_t* along = nullptr;
  std::int32_t around = 0;  ///< number of segments of that curve
};

/// Finds owners, adds to the sums, and returns Σ m · distance².
double scan_blocks(const TileScan& tile);

/// Drops those of `count` entries whose segments are, for every sample with weight, farther than the nearest
/// one by more than `slack`. Returns how many are left, in their order at the beginning of `entries`.
/// `border` is null for a block wholly inside. `scratch` is used for distances.
std::size_t keep_near(const Lattice::Block& block, const Lattice::BorderBlock* border, float pitch,
                      const TileSegment* segments, float slack, std::int32_t* entries, std::size_t count,
                      std::vector<float>& scratch);

/// Squared distances from (x, y) to segments, given as one array for each member of TileSegment. Works on
/// eight at a time, and so reads and writes up to seven entries past `count`. Returns the least.
float distances_from(float x, float y, const float* ax, const float* ay, const float* ux, const float* uy,
                     const float* inverse, std::size_t count, float* distance2);

/// Writes the numbers first, first + 1, … of those distances that are within a limit. Reads and writes up to
/// eight entries past the end. Returns how many there are.
std::size_t numbers_within(const float* distance2, std::size_t count, float limit2, std::int32_t first,
                           std::int32_t* numbers);

/// Points and segments as one array per number; those of segments are as in TileSegment.
struct PointArrays {
  const double *x, *y;
};
struct SegmentArraysView {
  const double *ax, *ay, *ux, *uy, *inverse;
};

/// Squared distances, mm², from a point to segments and from a segment to points. Work on four at a time, and
/// so read and write up to three entries past `count`.
void distances_to_segments(double x, double y, const SegmentArraysView& segments, std::size_t count,
                           double* distance2);
void distances_to_points(double ax, double ay, double ux, double uy, double inverse,
                         const PointArrays& points, std::size_t count, double* distance2);

}  // namespace unicursal::core
