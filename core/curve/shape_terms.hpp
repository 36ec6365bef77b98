// The objectives that depend on the curve alone: length (27, 28) and smoothness (29, 30).
#pragma once

#include <vector>

#include "core/curve/curve.hpp"

namespace unicursal::core {

/// Returns the curve's length L, mm, and adds `weight` · ∂L/∂v to the gradient. Coinciding neighbours add
/// nothing.
double length_with_gradient(const Curve& curve, double weight, std::vector<Vec2>& gradient);

/// Returns Σ ‖v_i − (v_{i−} + v_{i+})/2‖² (29), mm², and adds `weight` times its gradient (30).
double smoothness_with_gradient(const Curve& curve, double weight, std::vector<Vec2>& gradient);

/// The value of (29) without a gradient, mm².
double smoothness(const Curve& curve);

}  // namespace unicursal::core
