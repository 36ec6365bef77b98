#include "core/curve/leash.hpp"

#include <cmath>

namespace unicursal::core {
namespace {

constexpr double freedom_in_widths = 0.5;  ///< greatest clearance that is measured, bead widths
constexpr double border_margin = 0.02;  ///< bead widths; a curve this close to the border counts as touching
constexpr double self_margin = 0.005;   ///< bead widths; strands this close count as touching
constexpr double tight = 0.5;   ///< a vertex that has used this share of its freedom counts as held back
constexpr double many = 0.01;   ///< share of vertices held back above which clearances are measured again
constexpr int some_steps = 10;  ///< steps after which a single vertex held back suffices

}  // namespace

void Leash::fasten(const Curve& curve) {
  anchor_ = curve.vertices;
  free_ = freedom(curve, border_, freedom_in_widths * width_, {border_margin * width_, self_margin * width_},
                  workers_);
  tight_ = 0;
  steps_ = 0;
}

void Leash::limit(Curve& curve) {
  tight_ = 0;
  for (std::size_t i = 0; i < curve.size(); ++i) {
    const Vec2 move = curve.vertices[i] - anchor_[i];
    const double length2 = move.squaredNorm(), free = free_[i];
    if (length2 <= tight * tight * free * free) continue;
    ++tight_;
    if (length2 <= free * free) continue;
    curve.vertices[i] = anchor_[i] + free * (1 - 1e-12) / std::sqrt(length2) * move;
  }
}

void Leash::follow(const Curve& curve) {
  ++steps_;
  const auto limit = many * static_cast<double>(curve.size());
  if (static_cast<double>(tight_) > limit || (tight_ > 0 && steps_ >= some_steps)) fasten(curve);
}

}  // namespace unicursal::core
