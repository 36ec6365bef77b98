// The innermost loops over points and segments: eight at a time in floats relative to a lattice's tile, four
// in doubles where exactness matters. Compiled twice and chosen at run time; neither version fuses
// multiplications, so both give the same bytes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/geometry/lattice.hpp"

namespace unicursal::core {

struct TileSegment {
  float ax, ay, ux, uy;  ///< start and way, mm
  float inverse;         ///< 1 ÷ length², 0 for a point
};

struct TileScan {
  const Lattice::Block* blocks;
  std::size_t count;
  const Lattice::BorderBlock* borders;
  float pitch;
  const TileSegment* segments;
  const std::uint32_t* start;   ///< per block, and one more
  const std::int32_t* entries;  ///< segments to test, per block
  std::int32_t* owner;          ///< out, per sample; −1 without weight
  std::array<float, 4>* sums;   ///< added to, per segment: Σ m off, Σ m t off
  const std::int32_t* along =
      nullptr;              ///< per segment its place along a closed curve; null: split no squares
  std::int32_t around = 0;  ///< segments of that curve
};

/// Finds owners, adds to the sums, and returns Σ m · distance².
double scan_blocks(const TileScan& tile);

/// Squared distances from (x, y) to segments, whose arrays hold what TileSegment does. Eight at a time: reads
/// and writes up to seven more than `count`.
void distances_from(float x, float y, const float* ax, const float* ay, const float* ux, const float* uy,
                    const float* inverse, std::size_t count, float* distance2);

/// Points and segments, one array for each number; a segment's as in TileSegment.
struct PointArrays {
  const double *x, *y;
};
struct SegmentArraysView {
  const double *ax, *ay, *ux, *uy, *inverse;
};

/// Squared distances, mm², from a point to segments and from a segment to points. Four at a time: reads and
/// writes up to three more than `count`.
void distances_to_segments(double x, double y, const SegmentArraysView& segments, std::size_t count,
                           double* distance2);
void distances_to_points(double ax, double ay, double ux, double uy, double inverse,
                         const PointArrays& points, std::size_t count, double* distance2);

}  // namespace unicursal::core
