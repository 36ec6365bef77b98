#include "core/geometry/nearest_kernel.hpp"

#include <cmath>
#include <cstring>
#include <limits>

#if defined(__x86_64__) && !defined(__SANITIZE_ADDRESS__)
#define UNICURSAL_VECTORISED __attribute__((target_clones("avx2", "default")))
#else
#define UNICURSAL_VECTORISED
#endif

namespace unicursal::core {
namespace {

using Floats = float __attribute__((vector_size(32)));
using Ints = std::int32_t __attribute__((vector_size(32)));
using Longs = std::int64_t __attribute__((vector_size(32)));
using Quad = float __attribute__((vector_size(16)));
using Doubles = double __attribute__((vector_size(32)));

static_assert(Lattice::block_columns == 4 && Lattice::block_rows == 2);
constexpr Floats square_x{0.5F, 1.5F, 2.5F, 3.5F, 0.5F, 1.5F, 2.5F, 3.5F};
constexpr Floats square_y{0.5F, 0.5F, 0.5F, 0.5F, 1.5F, 1.5F, 1.5F, 1.5F};
constexpr Ints lane_numbers{0, 1, 2, 3, 4, 5, 6, 7};
constexpr float same_direction = 0.5F;  ///< cosine above which two nearest points lie in the same direction
constexpr float infinite = std::numeric_limits<float>::infinity();
constexpr float list_rounding = 1e-5F;  ///< relative; added to the limit that decides which segments are kept

/// The nearest point of a segment, per sample.
struct Foot {
  Floats distance2, share, x, y;  ///< `share`: position on the segment, 0 to 1; x, y relative to the sample
  Ints owner;
};

#define UNICURSAL_INLINE inline __attribute__((always_inline))

UNICURSAL_INLINE Foot foot_on(const TileSegment& s, std::int32_t index, const Floats& x, const Floats& y) {
  const Floats zero{}, one = zero + 1.0F;
  const Floats px = x - s.ax, py = y - s.ay;
  Floats t = (px * s.ux + py * s.uy) * s.inverse;
  t = t < zero ? zero : t;
  t = t > one ? one : t;
  const Floats qx = t * s.ux - px, qy = t * s.uy - py;
  return {qx * qx + qy * qy, t, qx, qy, Ints{} + index};
}

UNICURSAL_INLINE void take(Foot& best, const Foot& foot, const Ints& where) {
  best.distance2 = where ? foot.distance2 : best.distance2;
  best.share = where ? foot.share : best.share;
  best.x = where ? foot.x : best.x;
  best.y = where ? foot.y : best.y;
  best.owner = where ? foot.owner : best.owner;
}

UNICURSAL_INLINE Foot nowhere() {
  const Floats zero{};
  return {zero + infinite, zero, zero, zero, Ints{} - 1};
}

UNICURSAL_INLINE Floats root(const Floats& v) {
  Floats result;
  for (std::size_t k = 0; k < Lattice::lanes; ++k) result[k] = std::sqrt(v[k]);
  return result;
}

UNICURSAL_INLINE void add(std::array<float, 4>* sums, const Foot& foot, const Floats& mass) {
  const Floats x = mass * foot.x, y = mass * foot.y, end_x = foot.share * x, end_y = foot.share * y;
  for (std::size_t k = 0; k < Lattice::lanes; ++k) {
    if (!(mass[k] > 0)) continue;
    Quad sum;
    std::array<float, 4>& place = sums[foot.owner[k]];
    std::memcpy(&sum, place.data(), sizeof sum);
    sum += Quad{x[k], y[k], end_x[k], end_y[k]};
    std::memcpy(place.data(), &sum, sizeof sum);
  }
}

/// The second owner of a split square: the nearest of the listed segments that are not neighbours of the
/// owner along the curve and lie in another direction. Other segments of the owner's own strand may be as
/// near, but the border between them and the owner does not matter.
UNICURSAL_INLINE Foot competitor(const TileScan& tile, std::uint32_t begin, std::uint32_t end,
                                 const Floats& x, const Floats& y, const Foot& own) {
  const Ints first{}, owner = own.owner < first ? first : own.owner;
  Ints place{};
  for (std::size_t k = 0; k < Lattice::lanes; ++k) place[k] = tile.along[owner[k]];
  const Floats zero{};
  Foot other = nowhere();
  for (std::uint32_t e = begin; e < end; ++e) {
    const std::int32_t index = tile.entries[e];
    const Ints forth = place - tile.along[index], gap = forth < 0 ? -forth : forth;
    const Foot foot = foot_on(tile.segments[index], index, x, y);
    const Floats along = own.x * foot.x + own.y * foot.y;
    const Ints aside =
        (along < zero) | (along * along < same_direction * same_direction * own.distance2 * foot.distance2);
    take(other, foot, (foot.distance2 < other.distance2) & aside & (gap > 1) & (gap < tile.around - 1));
  }
  return other;
}

/// The line on which both segments are equally far cuts the square. Returns the share of the square on the
/// other segment's side, 0 to ½, and lowers the mean squared distance accordingly.
UNICURSAL_INLINE Floats split(const Foot& own, const Foot& other, float pitch, Floats& mean) {
  const Floats zero{};
  const Ints both = (own.distance2 > zero) & (other.distance2 < zero + infinite);
  const Floats near = root(both ? own.distance2 : zero + 1.0F),
               far = root(both ? other.distance2 : zero + 1.0F);
  const Floats slope_x = own.x / near - other.x / far, slope_y = own.y / near - other.y / far;
  const Floats spread =
      pitch * ((slope_x < zero ? -slope_x : slope_x) + (slope_y < zero ? -slope_y : slope_y));
  Floats share = 0.5F - (far - near) / (spread > zero ? spread : zero + 1.0F);
  share = (share > zero) & (spread > zero) & both ? share : zero;
  mean = own.distance2 - share * share * spread * (near + far) * 0.5F;
  return share;
}

}  // namespace

UNICURSAL_VECTORISED
double scan_blocks(const TileScan& tile) {
  const Floats zero{};
  const Ints all = Ints{} - 1;
  double moment = 0;
  for (std::size_t b = 0; b < tile.count; ++b) {
    const Lattice::Block& block = tile.blocks[b];
    Floats x = block.x + tile.pitch * square_x, y = block.y + tile.pitch * square_y;
    Floats mass = zero + tile.pitch * tile.pitch;
    if (block.border >= 0) {
      const Lattice::BorderBlock& border = tile.borders[block.border];
      std::memcpy(&x, border.x.data(), sizeof x);
      std::memcpy(&y, border.y.data(), sizeof y);
      std::memcpy(&mass, border.weight.data(), sizeof mass);
    }
    const std::uint32_t begin = tile.start[b], end = tile.start[b + 1];
    Foot own = nowhere();
    for (std::uint32_t e = begin; e < end; ++e) {
      const std::int32_t index = tile.entries[e];
      const Foot foot = foot_on(tile.segments[index], index, x, y);
      take(own, foot, foot.distance2 < own.distance2);
    }
    if (begin == end) mass = zero;
    own.owner = mass > zero ? own.owner : all;
    std::memcpy(tile.owner + Lattice::lanes * b, &own.owner, sizeof own.owner);
    Floats mean = own.distance2;
    if (tile.along != nullptr && begin < end) {
      const Foot other = competitor(tile, begin, end, x, y, own);
      const Floats share = split(own, other, tile.pitch, mean);
      add(tile.sums, other, share * mass);
      add(tile.sums, own, (1.0F - share) * mass);
    } else {
      add(tile.sums, own, mass);
    }
    const Floats weighed = mass * mean;
    for (std::size_t k = 0; k < Lattice::lanes; ++k) moment += mass[k] > 0 ? weighed[k] : 0.0F;
  }
  return moment;
}

UNICURSAL_VECTORISED
std::size_t keep_near(const Lattice::Block& block, const Lattice::BorderBlock* border, float pitch,
                      const TileSegment* segments, float slack, std::int32_t* entries, std::size_t count,
                      std::vector<float>& scratch) {
  const Floats zero{};
  Floats x = block.x + pitch * square_x, y = block.y + pitch * square_y, mass = zero + 1.0F;
  if (border != nullptr) {
    std::memcpy(&x, border->x.data(), sizeof x);
    std::memcpy(&y, border->y.data(), sizeof y);
    std::memcpy(&mass, border->weight.data(), sizeof mass);
  }
  scratch.resize(Lattice::lanes * count);
  Floats nearest = zero + infinite;
  for (std::size_t e = 0; e < count; ++e) {
    const Floats d = foot_on(segments[entries[e]], 0, x, y).distance2;
    std::memcpy(scratch.data() + Lattice::lanes * e, &d, sizeof d);
    nearest = d < nearest ? d : nearest;
  }
  Floats limit = (root(nearest) + slack) * (1 + list_rounding);
  limit = mass > zero ? limit * limit : zero - 1.0F;
  std::size_t kept = 0;
  for (std::size_t e = 0; e < count; ++e) {
    Floats d;
    std::memcpy(&d, scratch.data() + Lattice::lanes * e, sizeof d);
    const Ints within = d <= limit;
    Longs pairs;
    std::memcpy(&pairs, &within, sizeof pairs);
    entries[kept] = entries[e];
    kept += ((pairs[0] | pairs[1]) | (pairs[2] | pairs[3])) != 0 ? 1 : 0;
  }
  return kept;
}

UNICURSAL_VECTORISED
float distances_from(float x, float y, const float* ax, const float* ay, const float* ux, const float* uy,
                     const float* inverse, std::size_t count, float* distance2) {
  const Floats zero{}, one = zero + 1.0F;
  Floats nearest = zero + infinite;
  for (std::size_t k = 0; k < count; k += Lattice::lanes) {
    Floats sx, sy, vx, vy, vi;
    std::memcpy(&sx, ax + k, sizeof sx);
    std::memcpy(&sy, ay + k, sizeof sy);
    std::memcpy(&vx, ux + k, sizeof vx);
    std::memcpy(&vy, uy + k, sizeof vy);
    std::memcpy(&vi, inverse + k, sizeof vi);
    const Floats px = x - sx, py = y - sy;
    Floats t = (px * vx + py * vy) * vi;
    t = t < zero ? zero : t;
    t = t > one ? one : t;
    const Floats qx = t * vx - px, qy = t * vy - py;
    Floats d = qx * qx + qy * qy;
    // What follows the end of the array does not count.
    const auto left = static_cast<std::int32_t>(count - k);
    d = lane_numbers < left ? d : zero + infinite;
    std::memcpy(distance2 + k, &d, sizeof d);
    nearest = d < nearest ? d : nearest;
  }
  float least = infinite;
  for (std::size_t k = 0; k < Lattice::lanes; ++k) least = nearest[k] < least ? nearest[k] : least;
  return least;
}

UNICURSAL_VECTORISED
std::size_t numbers_within(const float* distance2, std::size_t count, float limit2, std::int32_t first,
                           std::int32_t* numbers) {
  std::size_t kept = 0;
  for (std::size_t k = 0; k < count; k += Lattice::lanes) {
    Floats d;
    std::memcpy(&d, distance2 + k, sizeof d);
    const Ints within = d <= limit2;
    Longs pairs;
    std::memcpy(&pairs, &within, sizeof pairs);
    if (((pairs[0] | pairs[1]) | (pairs[2] | pairs[3])) == 0) continue;
    // Without branches: they would be unpredictable.
    for (std::size_t lane = 0; lane < Lattice::lanes; ++lane) {
      numbers[kept] = first + static_cast<std::int32_t>(k + lane);
      kept += within[lane] != 0 ? 1 : 0;
    }
  }
  return kept;
}

UNICURSAL_VECTORISED
void distances_to_segments(double x, double y, const SegmentArraysView& segments, std::size_t count,
                           double* distance2) {
  const Doubles zero{}, one = zero + 1.0;
  for (std::size_t k = 0; k < count; k += 4) {
    Doubles sx, sy, vx, vy, vi;
    std::memcpy(&sx, segments.ax + k, sizeof sx);
    std::memcpy(&sy, segments.ay + k, sizeof sy);
    std::memcpy(&vx, segments.ux + k, sizeof vx);
    std::memcpy(&vy, segments.uy + k, sizeof vy);
    std::memcpy(&vi, segments.inverse + k, sizeof vi);
    const Doubles px = x - sx, py = y - sy;
    Doubles t = (px * vx + py * vy) * vi;
    t = t < zero ? zero : t;
    t = t > one ? one : t;
    const Doubles qx = t * vx - px, qy = t * vy - py;
    const Doubles d = qx * qx + qy * qy;
    std::memcpy(distance2 + k, &d, sizeof d);
  }
}

UNICURSAL_VECTORISED
void distances_to_points(double ax, double ay, double ux, double uy, double inverse,
                         const PointArrays& points, std::size_t count, double* distance2) {
  const Doubles zero{}, one = zero + 1.0;
  for (std::size_t k = 0; k < count; k += 4) {
    Doubles x, y;
    std::memcpy(&x, points.x + k, sizeof x);
    std::memcpy(&y, points.y + k, sizeof y);
    const Doubles px = x - ax, py = y - ay;
    Doubles t = (px * ux + py * uy) * inverse;
    t = t < zero ? zero : t;
    t = t > one ? one : t;
    const Doubles qx = t * ux - px, qy = t * uy - py;
    const Doubles d = qx * qx + qy * qy;
    std::memcpy(distance2 + k, &d, sizeof d);
  }
}

}  // namespace unicursal::core
