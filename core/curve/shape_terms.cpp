#include "core/curve/shape_terms.hpp"

namespace unicursal::core {

double length_with_gradient(const Curve& curve, double weight, std::vector<Vec2>& gradient) {
  double length = 0;
  for (std::size_t i = 0; i < curve.size(); ++i) {
    const std::size_t j = curve.after(i);
    const Vec2 u = curve.vertices[j] - curve.vertices[i];
    const double l = u.norm();
    length += l;
    if (l <= 0) continue;
    gradient[i] -= weight / l * u;
    gradient[j] += weight / l * u;
  }
  return length;
}

double smoothness_with_gradient(const Curve& curve, double weight, std::vector<Vec2>& gradient) {
  double value = 0;
  for (std::size_t i = 0; i < curve.size(); ++i) {
    const std::size_t before = curve.before(i), after = curve.after(i);
    const Vec2 off = curve.vertices[i] - (curve.vertices[before] + curve.vertices[after]) / 2;
    value += off.squaredNorm();
    gradient[i] += 2 * weight * off;
    gradient[before] -= weight * off;
    gradient[after] -= weight * off;
  }
  return value;
}

double smoothness(const Curve& curve) {
  std::vector<Vec2> ignored(curve.size(), Vec2(0, 0));
  return smoothness_with_gradient(curve, 0, ignored);
}

}  // namespace unicursal::core
