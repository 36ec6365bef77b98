#include "core/geometry/lattice.hpp"

#include <cmath>
#include <numeric>
#include <stdexcept>

namespace unicursal::core {
namespace {

/// Rings clipped to a half-plane one after another (Sutherland and Hodgman). For a non-convex ring the result
/// may hold edges that run back and forth along the clipping line; they cancel in every moment.
enum class Side { left, right, below, above };

bool keeps(Side side, const Vec2& p, double at) {
  switch (side) {
    case Side::left:
      return p.x() <= at;
    case Side::right:
      return p.x() >= at;
    case Side::below:
      return p.y() <= at;
    case Side::above:
      return p.y() >= at;
  }
  return false;
}

Vec2 crossing(Side side, const Vec2& a, const Vec2& b, double at) {
  if (side == Side::left || side == Side::right) {
    return {at, a.y() + (b.y() - a.y()) * (at - a.x()) / (b.x() - a.x())};
  }
  return {a.x() + (b.x() - a.x()) * (at - a.y()) / (b.y() - a.y()), at};
}

std::vector<Ring> clipped(const std::vector<Ring>& rings, Side side, double at) {
  std::vector<Ring> result;
  for (const Ring& ring : rings) {
    Ring kept;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vec2 &a = ring[i], &b = ring[(i + 1) % ring.size()];
      const bool a_in = keeps(side, a, at), b_in = keeps(side, b, at);
      if (a_in) kept.push_back(a);
      if (a_in != b_in) kept.push_back(crossing(side, a, b, at));
    }
    if (kept.size() >= 3) result.push_back(std::move(kept));
  }
  return result;
}

struct Moments {
  double area = 0;
  Vec2 first{0, 0};  ///< area times centroid
};

Moments moments(const std::vector<Ring>& rings, const Vec2& about) {
  Moments m;
  for (const Ring& ring : rings) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vec2 a = ring[i] - about, b = ring[(i + 1) % ring.size()] - about;
      const double twice = cross(a, b);
      m.area += twice / 2;
      m.first += twice / 6 * (a + b);
    }
  }
  return m;
}

class Sampler {
 public:
  explicit Sampler(Lattice& lattice) : lattice_(lattice) {}

  /// Fills the squares [c0, c1) × [r0, r1) from rings that are already clipped to them.
  void fill(const std::vector<Ring>& rings, std::size_t c0, std::size_t c1, std::size_t r0, std::size_t r1) {
    if (rings.empty() || c0 == c1 || r0 == r1) return;
    const Vec2 low =
        lattice_.origin + lattice_.pitch * Vec2(static_cast<double>(c0), static_cast<double>(r0));
    const Vec2 high =
        lattice_.origin + lattice_.pitch * Vec2(static_cast<double>(c1), static_cast<double>(r1));
    const double whole = (high - low).prod();
    const Moments m = moments(rings, low);
    if (m.area > whole * (1 - 1e-12)) {
      for (std::size_t r = r0; r < r1; ++r) {
        for (std::size_t c = c0; c < c1; ++c) set(c, r, 1);
      }
    } else if (c1 - c0 == 1 && r1 - r0 == 1) {
      if (m.area > 1e-9 * whole) {
        const Vec2 centroid = low + m.first / m.area - lattice_.origin;
        const std::size_t k = r0 * lattice_.columns + c0;
        lattice_.x[k] = static_cast<float>(centroid.x());
        lattice_.y[k] = static_cast<float>(centroid.y());
        lattice_.weight[k] = static_cast<float>(m.area);
      }
    } else if (c1 - c0 >= r1 - r0) {
      const std::size_t middle = (c0 + c1) / 2;
      const double at = lattice_.origin.x() + lattice_.pitch * static_cast<double>(middle);
      fill(clipped(rings, Side::left, at), c0, middle, r0, r1);
      fill(clipped(rings, Side::right, at), middle, c1, r0, r1);
    } else {
      const std::size_t middle = (r0 + r1) / 2;
      const double at = lattice_.origin.y() + lattice_.pitch * static_cast<double>(middle);
      fill(clipped(rings, Side::below, at), c0, c1, r0, middle);
      fill(clipped(rings, Side::above, at), c0, c1, middle, r1);
    }
  }

 private:
  void set(std::size_t c, std::size_t r, double share) {
    const std::size_t k = r * lattice_.columns + c;
    lattice_.weight[k] = static_cast<float>(share * lattice_.pitch * lattice_.pitch);
  }

  Lattice& lattice_;
};

}  // namespace

double Lattice::total_weight() const {
  return std::accumulate(weight.begin(), weight.end(), 0.0);
}

Lattice sample(const Polygon& polygon, double pitch) {
  const Box box = bounds(polygon);
  Lattice lattice;
  lattice.pitch = pitch;
  lattice.origin = box.min;
  const Vec2 squares = ((box.size() / pitch).array() + 1).floor();
  if (!(squares.x() * squares.y() < 2147483648.0)) throw std::length_error("sampling lattice too fine");
  lattice.columns = static_cast<std::size_t>(squares.x());
  lattice.rows = static_cast<std::size_t>(squares.y());
  const std::size_t count = lattice.columns * lattice.rows;
  lattice.x.resize(count);
  lattice.y.resize(count);
  lattice.weight.assign(count, 0);
  for (std::size_t r = 0; r < lattice.rows; ++r) {
    for (std::size_t c = 0; c < lattice.columns; ++c) {
      lattice.x[r * lattice.columns + c] = static_cast<float>((static_cast<double>(c) + 0.5) * pitch);
      lattice.y[r * lattice.columns + c] = static_cast<float>((static_cast<double>(r) + 0.5) * pitch);
    }
  }
  std::vector<Ring> rings{polygon.outer};
  rings.insert(rings.end(), polygon.holes.begin(), polygon.holes.end());
  Sampler(lattice).fill(rings, 0, lattice.columns, 0, lattice.rows);
  return lattice;
}

}  // namespace unicursal::core
