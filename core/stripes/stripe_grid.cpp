#include "core/stripes/stripe_grid.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/stopping.hpp"

namespace unicursal::core {
namespace {

constexpr double nodes_per_width = 2;
constexpr double blur = 0.9;       ///< standard deviation of the blur, bead widths
constexpr double wide_blur = 1.8;  ///< where directions cancel each other or none is asked for
constexpr double no_direction = 1e-6;
constexpr int blur_steps = 4;   ///< of half a standard deviation, to either side
constexpr double beyond = 1.5;  ///< pitches; nodes up to this far outside are kept

Vec2 blurred(const DirectionField& field, const Vec2& p, double deviation) {
  std::array<double, 2 * blur_steps + 1> weight{};
  for (int k = -blur_steps; k <= blur_steps; ++k)
    weight[static_cast<std::size_t>(k + blur_steps)] = std::exp(-k * k / 8.0);
  Vec2 sum(0, 0);
  for (int x = -blur_steps; x <= blur_steps; ++x) {
    for (int y = -blur_steps; y <= blur_steps; ++y) {
      const double share =
          weight[static_cast<std::size_t>(x + blur_steps)] * weight[static_cast<std::size_t>(y + blur_steps)];
      sum += share * field.at(p + deviation / 2 * Vec2(x, y));
    }
  }
  return sum;
}

Vec2 across(const DirectionField& field, const Vec2& p, double bead_width) {
  Vec2 v = blurred(field, p, blur * bead_width);
  if (v.norm() < no_direction) v = blurred(field, p, wide_blur * bead_width);
  const double along = v.norm() > 0 ? direction(v) : 0.0;
  return {-std::sin(along), std::cos(along)};
}

}  // namespace

double stripe_nodes(const Polygon& region, double bead_width) {
  return area(region) * std::pow(nodes_per_width / bead_width, 2);
}

StripeGrid stripe_grid(const Polygon& region, const BorderIndex& border, const DirectionField& field,
                       double bead_width) {
  const Box box = bounds(region);
  StripeGrid grid;
  grid.pitch = bead_width / nodes_per_width;
  grid.origin = box.min - 2 * grid.pitch * Vec2(1, 1);
  grid.columns = static_cast<std::ptrdiff_t>(std::ceil(box.size().x() / grid.pitch)) + 5;
  grid.rows = static_cast<std::ptrdiff_t>(std::ceil(box.size().y() / grid.pitch)) + 5;
  grid.nodes.assign(static_cast<std::size_t>(grid.columns * grid.rows), -1);
  const double reach = beyond * grid.pitch;
  for (std::ptrdiff_t row = 0; row < grid.rows; ++row) {
    stop_point();
    for (std::ptrdiff_t column = 0; column < grid.columns; ++column) {
      const Vec2 p = grid.origin + grid.pitch * Vec2(static_cast<double>(column), static_cast<double>(row));
      if (!border.contains(p) && border.distance(p, p, reach) >= reach) continue;
      grid.nodes[static_cast<std::size_t>(row * grid.columns + column)] =
          static_cast<std::ptrdiff_t>(grid.size());
      grid.positions.push_back(p);
      grid.normals.push_back(across(field, p, bead_width));
    }
  }
  return grid;
}

NearBorder near_border(const BorderIndex& border, const Vec2& point, double reach) {
  NearBorder nearest{reach, Vec2(0, 0)};
  const Vec2 margin(reach, reach);
  border.near({point - margin, point + margin}, [&](std::size_t k) {
    const BorderEdge& edge = border.edges()[k];
    const Vec2 u = edge.b - edge.a;
    const double length2 = u.squaredNorm();
    if (!(length2 > 0)) return;
    const double t = std::clamp((point - edge.a).dot(u) / length2, 0.0, 1.0);
    const Vec2 off = point - edge.a - t * u;
    const double distance = off.norm();
    if (distance >= nearest.distance) return;
    // On the border itself its own normal counts, which points to the inside.
    nearest = {distance,
               distance > 1e-9 ? Vec2(off / distance) : Vec2(perpendicular(u) / std::sqrt(length2))};
  });
  return nearest;
}

}  // namespace unicursal::core
