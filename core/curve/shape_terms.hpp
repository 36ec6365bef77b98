// The objectives that depend on the curve alone: length (27, 28) and smoothness (29, 30).
#pragma once

#include <vector>

#include "core/curve/curve.hpp"

namespace unicursal::core {

/// The curve's length L, mm; adds `weight` · ∂L/∂v to the gradient. Coinciding neighbours pull nothing.
double length_with_gradient(const Curve& curve, double weight, std::vector<Vec2>& gradient);

/// Σ ‖v_i − (v_{i−} + v_{i+})/2‖² (29), mm²; adds `weight` times its gradient (30).
double smoothness_with_gradient(const Curve& curve, double weight, std::vector<Vec2>& gradient);

/// (29) alone.
double smoothness(const Curve& curve);

}  // namespace unicursal::core
