#include "core/stripes/chains.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/curve/track.hpp"

namespace unicursal::core {
namespace {

constexpr double least_field = 0.1;  ///< a smaller ‖V‖ asks for no direction
constexpr double fewest_points = 6;  ///< of a loop

}  // namespace

Chains chains_of(const std::vector<Curve>& loops, const DirectionField& field, double step, int smoothing) {
  Chains chains;
  chains.step = step;
  for (std::size_t l = 0; l < loops.size(); ++l) {
    const Track track(loops[l]);
    const auto count = static_cast<std::size_t>(std::max(std::round(track.length() / step), fewest_points));
    const std::size_t first = chains.size();
    for (std::size_t k = 0; k < count; ++k) {
      chains.points.push_back(track.at(track.length() * static_cast<double>(k) / static_cast<double>(count)));
      chains.loops.push_back(l);
      chains.after.push_back(first + (k + 1) % count);
      chains.before.push_back(first + (k + count - 1) % count);
    }
  }
  for (int pass = 0; pass < smoothing; ++pass) {
    std::vector<Vec2> smooth(chains.size());
    for (std::size_t i = 0; i < smooth.size(); ++i) {
      const Vec2 &before = chains.points[chains.before[i]], &after = chains.points[chains.after[i]];
      smooth[i] = (before + 2 * chains.points[i] + after) / 4;
    }
    chains.points = std::move(smooth);
  }
  chains.off.resize(chains.size());
  for (std::size_t i = 0; i < chains.size(); ++i)
    chains.off[i] = off_field(chains.points[i], chains.points[chains.after[i]], field, step);
  return chains;
}

double off_field(const Vec2& a, const Vec2& b, const DirectionField& field, double step) {
  const Vec2 u = b - a;
  const double length = u.norm();
  if (!(length > 0)) return 0;
  const double angle = std::atan2(u.y(), u.x());
  const double pieces = std::max(1.0, std::ceil(length / step));
  double sum = 0;
  for (double k = 0.5; k < pieces; ++k) {
    const Vec2 v = field.at(a + k / pieces * u);
    if (v.norm() < least_field) continue;
    const double off = std::remainder(angle - direction(v), std::numbers::pi);
    sum += off * off * std::min(1.0, v.norm());
  }
  return sum * length / pieces;
}

}  // namespace unicursal::core
