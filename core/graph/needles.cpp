#include "core/graph/needles.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/geometry/segment_grid.hpp"
#include "core/graph/seeds.hpp"
#include "core/stopping.hpp"

namespace unicursal::core {
namespace {

constexpr double samples_per_distance = 8;  ///< lattice squares per d; at 5, seeds stick to the lattice
constexpr double most_of_the_way = 0.9;  ///< longest half needle, as a share of the way to the cell's border
constexpr double least_needle = 0.02;    ///< a shorter needle, as a share of d, becomes a point
constexpr double longest_step = 0.3;     ///< of a seed in one iteration, as a share of d
constexpr double sufficient_decrease = 1e-4;  ///< Armijo
constexpr int most_halvings = 5;
constexpr int renewal = 5;  ///< iterations between new needles

/// How far the line through `seed` along the unit vector `u` can be followed in both directions within the
/// seed's cell: up to the bisectors with other seeds and to the domain's border, at most `most`.
double way_in_cell(const Vec2& seed, const Vec2& u, double most, const std::vector<Vec2>& seeds,
                   const SegmentGrid& grid, const BorderIndex& border) {
  double way = most;
  const Vec2 wide(2 * most, 2 * most), close(most, most);
  grid.near({seed - wide, seed + wide}, [&](std::size_t other) {
    const Vec2 apart = seeds[other] - seed;
    const double along = std::abs(apart.dot(u));
    if (along * 2 * way > apart.squaredNorm()) way = apart.squaredNorm() / (2 * along);
  });
  border.near({seed - close, seed + close}, [&](std::size_t e) {
    const Vec2 from = border.edges()[e].a - seed, edge = border.edges()[e].b - border.edges()[e].a;
    const double slope = cross(u, edge);
    if (slope == 0) return;
    const double along_edge = cross(from, u) / slope;
    if (along_edge >= 0 && along_edge <= 1) way = std::min(way, std::abs(cross(from, edge) / slope));
  });
  return way;
}

}  // namespace

NeedleTessellation::NeedleTessellation(const Polygon& domain, const DirectionField& field, double d,
                                       double length)
    : d_(d),
      length_(length),
      lattice_(sample(domain, std::max(d / samples_per_distance, bounds(domain).size().maxCoeff() / 30000))),
      owners_(lattice_),
      border_(domain, d),
      area_(area(domain)),
      asked_(lattice_.size(), Eigen::Vector2f(0, 0)) {
  for (std::size_t k = 0; k < lattice_.size(); ++k) {
    if (lattice_.weight(k) > 0)
      asked_[k] = (lattice_.weight(k) * field.at(lattice_.position(k))).cast<float>();
  }
}

std::vector<Segment> NeedleTessellation::needles(const std::vector<Vec2>& seeds) {
  std::vector<Segment> result = as_points(seeds);
  owners_.assign(result);
  std::vector<Vec2> asked(seeds.size(), Vec2(0, 0));
  std::vector<double> cell_area(seeds.size(), 0);
  for (std::size_t k = 0; k < lattice_.size(); ++k) {
    if (owners_.owner(k) < 0) continue;
    const std::int32_t owner = owners_.owner(k);
    asked[owner] += asked_[k].cast<double>();
    cell_area[owner] += lattice_.weight(k);
  }
  const SegmentGrid grid(result, d_);
  const double unit = length_ * std::sqrt(area_ / (std::numbers::pi * static_cast<double>(seeds.size())));
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    if (!(cell_area[i] > 0)) continue;
    const double length = asked[i].norm() / cell_area[i] * unit;
    if (length < least_needle * d_) continue;
    const double angle = direction(asked[i]);
    const Vec2 u(std::cos(angle), std::sin(angle));
    const double half = way_in_cell(seeds[i], u, length / 2 / most_of_the_way, seeds, grid, border_);
    result[i] = {seeds[i] - most_of_the_way * half * u, seeds[i] + most_of_the_way * half * u};
  }
  return result;
}

double NeedleTessellation::coverage(const std::vector<Segment>& needles, std::vector<Vec2>& gradient) {
  owners_.assign(needles);
  gradient.resize(needles.size());
  // The pulls (15), (21), (22) on the two ends add up to the pull on the seed between them.
  for (std::size_t i = 0; i < needles.size(); ++i) gradient[i] = 2 * owners_.pulls()[i].all;
  return owners_.second_moment();
}

/// Takes one step along a descent direction; all needles move without turning. Returns false if no acceptable
/// step was found.
bool NeedleTessellation::step(Descent& state) {
  const std::vector<Vec2> direction = state.newton.direction(state.gradient);
  double longest = 0;
  for (const Vec2& v : direction) longest = std::max(longest, v.norm());
  if (!(longest > 0)) return false;
  // The first step is that of Lloyd's method, as if every cell had the mean area.
  const double first = static_cast<double>(direction.size()) / (2 * area_);
  double scale = std::min(state.newton.empty() ? first : 1.0, longest_step * d_ / longest);
  std::vector<Vec2> gradient;
  for (int halving = 0; halving < most_halvings; ++halving, scale /= 2) {
    std::vector<Segment> moved = state.needles;
    std::vector<Vec2> move(moved.size(), Vec2(0, 0));
    for (std::size_t i = 0; i < moved.size(); ++i) {
      const Vec2 wanted = scale * direction[i];
      if (border_.contains((moved[i].a + moved[i].b) / 2 + wanted)) move[i] = wanted;
      moved[i] = {moved[i].a + move[i], moved[i].b + move[i]};
    }
    const double slope = dot(state.gradient, move);
    if (!(slope < 0)) return false;
    const double value = coverage(moved, gradient);
    if (value > state.value + sufficient_decrease * slope) continue;
    std::vector<Vec2> change = gradient;
    add_scaled(change, -1, state.gradient);
    state.newton.remember(std::move(move), std::move(change));
    state.needles = std::move(moved);
    state.gradient = std::move(gradient);
    state.value = value;
    return true;
  }
  return false;
}

void NeedleTessellation::relax(std::vector<Vec2>& seeds, int iterations) {
  Descent state;
  for (int i = 0; i < iterations; ++i) {
    stop_point();
    if (i % renewal == 0) {
      state.needles = needles(seeds);
      state.value = coverage(state.needles, state.gradient);
    }
    if (step(state)) {
      for (std::size_t k = 0; k < seeds.size(); ++k) seeds[k] = (state.needles[k].a + state.needles[k].b) / 2;
    } else {
      if (state.newton.empty()) return;
      state.newton.forget();
    }
  }
}

}  // namespace unicursal::core
