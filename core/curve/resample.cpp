#include "core/curve/resample.hpp"

#include <cmath>

#include "core/curve/clearance.hpp"

namespace unicursal::core {
namespace {

constexpr double too_close = 0.5, too_far = 1.5;  ///< of the spacing
constexpr std::size_t fewest_vertices = 8;
constexpr int most_sweeps = 6;

/// One sweep; a dropped vertex's neighbours stay, so that every move is measured against its own clearance.
Curve thinned_once(const Curve& curve, const BorderIndex& border, double spacing, Workers* workers) {
  const std::vector<double> free = freedom(curve, border, spacing, {}, workers);
  Curve result;
  bool dropped = true;  // the first vertex stays
  std::size_t left = curve.size();
  for (std::size_t i = 0; i < curve.size(); ++i) {
    const Vec2 &before = curve.vertices[curve.before(i)], &here = curve.vertices[i];
    const Vec2& after = curve.vertices[curve.after(i)];
    const double nearest = std::min((here - before).norm(), (after - here).norm());
    if (!dropped && i + 1 < curve.size() && left > fewest_vertices && nearest < too_close * spacing &&
        (after - before).norm() < too_far * spacing && distance_to_segment(here, before, after) < free[i]) {
      dropped = true;
      --left;
      continue;
    }
    dropped = false;
    result.vertices.push_back(here);
  }
  return result;
}

}  // namespace

Curve thinned(const Curve& curve, const BorderIndex& border, double spacing, Workers* workers) {
  Curve thin = curve;
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    const std::size_t size = thin.size();
    thin = thinned_once(thin, border, spacing, workers);
    if (thin.size() == size) break;
  }
  return thin;
}

Curve respaced(const Curve& curve, const BorderIndex& border, double spacing, Workers* workers) {
  const Curve thin = thinned(curve, border, spacing, workers);
  Curve result;
  for (std::size_t i = 0; i < thin.size(); ++i) {
    const Vec2 &a = thin.vertices[i], &b = thin.vertices[thin.after(i)];
    const auto pieces = static_cast<int>(std::floor((b - a).norm() / (too_far * spacing))) + 1;
    for (int k = 0; k < pieces; ++k) result.vertices.push_back(a + static_cast<double>(k) / pieces * (b - a));
  }
  return result;
}

Curve subdivided(const Curve& curve) {
  Curve result;
  result.vertices.reserve(2 * curve.size());
  for (std::size_t i = 0; i < curve.size(); ++i) {
    result.vertices.push_back(curve.vertices[i]);
    result.vertices.push_back((curve.vertices[i] + curve.vertices[curve.after(i)]) / 2);
  }
  return result;
}

}  // namespace unicursal::core
