#include "core/curve/coverage.hpp"

#include <algorithm>

namespace unicursal::core {

Coverage::Coverage(const Lattice& lattice, double reach)
    : lattice_(lattice), reach_(reach), owners_(lattice) {}

double Coverage::evaluate(const Curve& curve, double weight, std::vector<Vec2>& gradient) {
  segments_.resize(curve.size());
  for (std::size_t i = 0; i < curve.size(); ++i)
    segments_[i] = {curve.vertices[i], curve.vertices[curve.after(i)]};
  owners_.assign(segments_, reach_);
  double value = 0;
  for (std::size_t k = 0; k < lattice_.size(); ++k) {
    const std::int32_t owner = owners_.owner(k);
    const double mass = lattice_.weight[k];
    if (owner < 0 || mass <= 0) continue;
    const auto i = static_cast<std::size_t>(owner), j = curve.after(i);
    const Vec2 p = lattice_.origin + Vec2(lattice_.x[k], lattice_.y[k]) - curve.vertices[i];
    const Vec2 u = curve.vertices[j] - curve.vertices[i];
    const double length2 = u.squaredNorm();
    const double t = length2 > 0 ? std::clamp(p.dot(u) / length2, 0.0, 1.0) : 0.0;
    const Vec2 off = t * u - p;
    value += mass * off.squaredNorm();
    const Vec2 pull = 2 * weight * mass * off;
    gradient[i] += (1 - t) * pull;
    gradient[j] += t * pull;
  }
  return value;
}

}  // namespace unicursal::core
