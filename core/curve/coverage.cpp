#include "core/curve/coverage.hpp"

#include <algorithm>
#include <cmath>

namespace unicursal::core {

Coverage::Coverage(const Lattice& lattice, double reach)
    : lattice_(lattice), reach_(reach), owners_(lattice) {}

double Coverage::evaluate(const Curve& curve, double weight, std::vector<Vec2>& gradient) {
  segments_.resize(curve.size());
  for (std::size_t i = 0; i < curve.size(); ++i)
    segments_[i] = {curve.vertices[i], curve.vertices[curve.after(i)]};
  owners_.assign(segments_, reach_);
  double value = 0;
  const auto pull = [&](const Foot& foot, double mass) {
    const Vec2 force = 2 * weight * mass * foot.off;
    gradient[foot.segment] += (1 - foot.along) * force;
    gradient[curve.after(foot.segment)] += foot.along * force;
  };
  for (std::size_t k = 0; k < lattice_.size(); ++k) {
    const std::int32_t owner = owners_.owner(k);
    const double mass = lattice_.weight[k];
    if (owner < 0 || mass <= 0) continue;
    const Vec2 p = lattice_.origin + Vec2(lattice_.x[k], lattice_.y[k]);
    const Foot own = foot_on(p, static_cast<std::size_t>(owner));
    value += mass * own.off.squaredNorm();
    const std::optional<Foot> other = competitor(k, p, own);
    const Split split = other ? split_between(own, *other) : Split{};
    pull(own, (1 - split.share) * mass);
    if (split.share > 0) {
      pull(*other, split.share * mass);
      value -= mass * split.gain;
    }
  }
  return value;
}

Coverage::Foot Coverage::foot_on(const Vec2& p, std::size_t segment) const {
  const Segment& s = segments_[segment];
  const Vec2 u = s.b - s.a;
  const double length2 = u.squaredNorm();
  const double along = length2 > 0 ? std::clamp((p - s.a).dot(u) / length2, 0.0, 1.0) : 0.0;
  return {segment, along, s.a + along * u - p};
}

/// The nearest segment that owns a neighbouring square and does not follow or precede the sample's own.
std::optional<Coverage::Foot> Coverage::competitor(std::size_t k, const Vec2& p, const Foot& own) const {
  const std::size_t column = k % lattice_.columns;
  std::optional<Foot> best;
  const auto consider = [&](std::size_t neighbour) {
    const std::int32_t j = owners_.owner(neighbour);
    if (j < 0) return;
    const auto segment = static_cast<std::size_t>(j);
    const std::size_t gap = segment > own.segment ? segment - own.segment : own.segment - segment;
    if (gap <= 1 || gap + 1 >= segments_.size()) return;
    const Foot foot = foot_on(p, segment);
    if (!best || foot.off.squaredNorm() < best->off.squaredNorm()) best = foot;
  };
  if (column > 0) consider(k - 1);
  if (column + 1 < lattice_.columns) consider(k + 1);
  if (k >= lattice_.columns) consider(k - lattice_.columns);
  if (k + lattice_.columns < lattice_.size()) consider(k + lattice_.columns);
  return best;
}

/// The line where both segments are equally far cuts the square; distances change across it as their
/// directions say.
Coverage::Split Coverage::split_between(const Foot& own, const Foot& other) const {
  const double near = own.off.norm(), far = other.off.norm();
  if (!(near > 0) || !(far > 0)) return {};
  const Vec2 slope = own.off / near - other.off / far;
  const double spread = lattice_.pitch * (std::abs(slope.x()) + std::abs(slope.y()));
  const double share = spread > 0 ? 0.5 - (far - near) / spread : 0.0;
  if (!(share > 0)) return {};
  return {share, share * share * spread * (near + far) / 2};
}

}  // namespace unicursal::core
