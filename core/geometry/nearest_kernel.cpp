#include "core/geometry/nearest_kernel.hpp"

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
using Quad = float __attribute__((vector_size(16)));
using Doubles = double __attribute__((vector_size(32)));

static_assert(Lattice::block_columns == 4 && Lattice::block_rows == 2);
constexpr Floats square_x{0.5F, 1.5F, 2.5F, 3.5F, 0.5F, 1.5F, 2.5F, 3.5F};
constexpr Floats square_y{0.5F, 0.5F, 0.5F, 0.5F, 1.5F, 1.5F, 1.5F, 1.5F};
constexpr float infinite = std::numeric_limits<float>::infinity();

}  // namespace

UNICURSAL_VECTORISED
double scan_blocks(const TileScan& tile) {
  const Floats zero{}, one = zero + 1.0F;
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
    Floats best = zero + infinite, share = zero, off_x = zero, off_y = zero;
    Ints owner = Ints{} - 1;
    for (std::uint32_t e = tile.start[b]; e < tile.start[b + 1]; ++e) {
      const std::int32_t index = tile.entries[e];
      const TileSegment& s = tile.segments[index];
      const Floats px = x - s.ax, py = y - s.ay;
      Floats t = (px * s.ux + py * s.uy) * s.inverse;
      t = t < zero ? zero : t;
      t = t > one ? one : t;
      const Floats qx = t * s.ux - px, qy = t * s.uy - py;
      const Floats d = qx * qx + qy * qy;
      const Ints nearer = d < best;
      best = nearer ? d : best;
      share = nearer ? t : share;
      off_x = nearer ? qx : off_x;
      off_y = nearer ? qy : off_y;
      owner = nearer ? Ints{} + index : owner;
    }
    owner = mass > zero ? owner : Ints{} - 1;
    std::memcpy(tile.owner + Lattice::lanes * b, &owner, sizeof owner);
    const Floats sum_x = mass * off_x, sum_y = mass * off_y;
    const Floats end_x = share * sum_x, end_y = share * sum_y, weighed = mass * best;
    for (std::size_t k = 0; k < Lattice::lanes; ++k) {
      if (owner[k] < 0) continue;
      Quad sum;
      std::array<float, 4>& place = tile.sums[owner[k]];
      std::memcpy(&sum, place.data(), sizeof sum);
      sum += Quad{sum_x[k], sum_y[k], end_x[k], end_y[k]};
      std::memcpy(place.data(), &sum, sizeof sum);
      moment += weighed[k];
    }
  }
  return moment;
}

UNICURSAL_VECTORISED
void distances_from(float x, float y, const float* ax, const float* ay, const float* ux, const float* uy,
                    const float* inverse, std::size_t count, float* distance2) {
  for (std::size_t k = 0; k < count; k += 8) {
    Floats sx, sy, vx, vy, vi;
    std::memcpy(&sx, ax + k, sizeof sx);
    std::memcpy(&sy, ay + k, sizeof sy);
    std::memcpy(&vx, ux + k, sizeof vx);
    std::memcpy(&vy, uy + k, sizeof vy);
    std::memcpy(&vi, inverse + k, sizeof vi);
    const Floats zero{}, one = zero + 1.0F;
    const Floats px = x - sx, py = y - sy;
    Floats t = (px * vx + py * vy) * vi;
    t = t < zero ? zero : t;
    t = t > one ? one : t;
    const Floats qx = t * vx - px, qy = t * vy - py;
    const Floats d = qx * qx + qy * qy;
    std::memcpy(distance2 + k, &d, sizeof d);
  }
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
