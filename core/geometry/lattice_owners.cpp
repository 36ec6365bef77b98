#include "core/geometry/lattice_owners.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

// The inner loop is compiled twice and chosen at run time. Neither version fuses multiplications, so both
// give the same bytes.
#if defined(__x86_64__) && !defined(__SANITIZE_ADDRESS__)
#define UNICURSAL_VECTORISED __attribute__((target_clones("avx2", "default")))
#else
#define UNICURSAL_VECTORISED
#endif

namespace unicursal::core {
namespace {

struct Scan {
  float ax, ay, ux, uy, inverse;  ///< start, direction, 1 ÷ length² (0 for a point)
};

UNICURSAL_VECTORISED
void scan_row(const float* __restrict x, const float* __restrict y, float* __restrict best,
              std::int32_t* __restrict owner, std::size_t count, Scan s, std::int32_t index) {
  for (std::size_t k = 0; k < count; ++k) {
    const float px = x[k] - s.ax, py = y[k] - s.ay;
    float t = (px * s.ux + py * s.uy) * s.inverse;
    t = t < 0.0F ? 0.0F : t;
    t = t > 1.0F ? 1.0F : t;
    const float qx = px - t * s.ux, qy = py - t * s.uy;
    const float d = qx * qx + qy * qy;
    const bool nearer = d < best[k];
    best[k] = nearer ? d : best[k];
    owner[k] = nearer ? index : owner[k];
  }
}

/// The x range of the points of a row that lie within `reach` of a segment; empty when low > high.
struct Span {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  void add(double from, double to) {
    low = std::min(low, from);
    high = std::max(high, to);
  }
};

Span span_of_row(const Vec2& a, const Vec2& b, double reach, double y) {
  Span span;
  for (const Vec2& p : {a, b}) {
    const double h = y - p.y();
    if (std::abs(h) <= reach) {
      const double half = std::sqrt(reach * reach - h * h);
      span.add(p.x() - half, p.x() + half);
    }
  }
  const Vec2 u = b - a;
  const double length = u.norm();
  if (length > 0) {
    for (const double side : {-reach, reach}) {
      const Vec2 p = a + side / length * perpendicular(u);
      if (u.y() == 0) continue;
      const double t = (y - p.y()) / u.y();
      if (t >= 0 && t <= 1) span.add(p.x() + t * u.x(), p.x() + t * u.x());
    }
  }
  return span;
}

}  // namespace

LatticeOwners::LatticeOwners(const Lattice& lattice)
    : lattice_(lattice), distance2_(lattice.size()), owner_(lattice.size()) {}

void LatticeOwners::splat(const Segment& segment, std::int32_t index, double reach) {
  const Vec2 a = segment.a - lattice_.origin, b = segment.b - lattice_.origin;
  const double pitch = lattice_.pitch;
  // A border sample sits up to half a pitch away from its square's centre: reach that much farther.
  const double wide = reach + 0.71 * pitch;
  const auto row_at = [&](double y) { return static_cast<std::ptrdiff_t>(std::floor(y / pitch)); };
  const std::ptrdiff_t first = std::max<std::ptrdiff_t>(row_at(std::min(a.y(), b.y()) - wide), 0);
  const std::ptrdiff_t last = std::min<std::ptrdiff_t>(row_at(std::max(a.y(), b.y()) + wide),
                                                       static_cast<std::ptrdiff_t>(lattice_.rows) - 1);
  const Vec2 u = b - a;
  const double length2 = u.squaredNorm();
  const Scan scan{static_cast<float>(a.x()), static_cast<float>(a.y()), static_cast<float>(u.x()),
                  static_cast<float>(u.y()), length2 > 0 ? static_cast<float>(1 / length2) : 0.0F};
  for (std::ptrdiff_t row = first; row <= last; ++row) {
    const Span span = span_of_row(a, b, wide, (static_cast<double>(row) + 0.5) * pitch);
    const double low = std::max(std::ceil(span.low / pitch - 0.5), 0.0);
    const double high =
        std::min(std::floor(span.high / pitch - 0.5), static_cast<double>(lattice_.columns) - 1);
    if (!(low <= high)) continue;
    const std::size_t from = static_cast<std::size_t>(row) * lattice_.columns + static_cast<std::size_t>(low);
    const auto count = static_cast<std::size_t>(high - low) + 1;
    scan_row(&lattice_.x[from], &lattice_.y[from], &distance2_[from], &owner_[from], count, scan, index);
  }
}

void LatticeOwners::assign(const std::vector<Segment>& segments, double reach) {
  std::fill(distance2_.begin(), distance2_.end(), std::numeric_limits<float>::infinity());
  std::fill(owner_.begin(), owner_.end(), -1);
  for (std::size_t s = 0; s < segments.size(); ++s) splat(segments[s], static_cast<std::int32_t>(s), reach);
  propagate(segments);
}

void LatticeOwners::propagate(const std::vector<Segment>& segments) {
  std::vector<std::size_t> open;
  for (std::size_t k = 0; k < owner_.size(); ++k) {
    if (lattice_.weight[k] > 0 && owner_[k] < 0) open.push_back(k);
  }
  while (!open.empty()) {
    std::vector<std::pair<std::size_t, std::int32_t>> found;
    std::vector<std::size_t> still_open;
    for (const std::size_t k : open) {
      const std::size_t row = k / lattice_.columns, column = k % lattice_.columns;
      const Vec2 p = lattice_.origin + Vec2(lattice_.x[k], lattice_.y[k]);
      double best = std::numeric_limits<double>::infinity();
      std::int32_t owner = -1;
      for (std::size_t r = row > 0 ? row - 1 : 0; r <= std::min(row + 1, lattice_.rows - 1); ++r) {
        for (std::size_t c = column > 0 ? column - 1 : 0; c <= std::min(column + 1, lattice_.columns - 1);
             ++c) {
          const std::int32_t other = owner_[r * lattice_.columns + c];
          if (other < 0) continue;
          const Segment& s = segments[static_cast<std::size_t>(other)];
          const double d = distance_to_segment(p, s.a, s.b);
          if (d < best) best = d, owner = other;
        }
      }
      if (owner < 0) {
        still_open.push_back(k);
      } else {
        distance2_[k] = static_cast<float>(best * best);
        found.emplace_back(k, owner);
      }
    }
    for (const auto& [k, owner] : found) owner_[k] = owner;
    if (found.empty()) return;
    open.swap(still_open);
  }
}

}  // namespace unicursal::core
