#include "core/curve/alignment.hpp"

#include <cmath>

namespace unicursal::core {
namespace {

constexpr double least_field = 0.1;  ///< a smaller ‖V‖ asks for no direction
constexpr int pieces = 4;            ///< of a segment; the field is looked up in each

/// The angle from direction `v` (a doubled vector) to the line along `u`, in [−π/2, π/2]: half of the angle
/// from v to u, doubled.
double angle_between(const Vec2& u, const Vec2& v) {
  const Vec2 doubled(u.x() * u.x() - u.y() * u.y(), 2 * u.x() * u.y());
  return std::atan2(cross(v, doubled), v.dot(doubled)) / 2;
}

}  // namespace

Alignment::Alignment(const Lattice& lattice, const DirectionField& field, double turn) {
  if (field.empty()) return;
  values_.resize(lattice.size(), {0, 0});
  const double c = std::cos(turn), s = std::sin(turn);
  const double c2 = std::cos(2 * turn), s2 = std::sin(2 * turn);
  for (std::size_t k = 0; k < lattice.size(); ++k) {
    const double mass = lattice.weight(k);
    if (mass <= 0) continue;
    const Vec2 p = lattice.position(k);
    const Vec2 v = field.at({c * p.x() + s * p.y(), c * p.y() - s * p.x()});
    values_[k] = {static_cast<float>(mass * (c2 * v.x() - s2 * v.y())),
                  static_cast<float>(mass * (s2 * v.x() + c2 * v.y()))};
  }
}

double Alignment::evaluate(const Curve& curve, const LatticeOwners& owners, double weight,
                           std::vector<Vec2>& gradient) const {
  const std::vector<Vec2> sums = owners.sums(values_);
  double value = 0;
  for (std::size_t i = 0; i < curve.size(); ++i) {
    const std::size_t j = curve.after(i);
    const Vec2 u = curve.vertices[j] - curve.vertices[i];
    const double asked = sums[i].norm(), length2 = u.squaredNorm();
    if (!(asked > 0) || !(length2 > 0)) continue;
    const double off = angle_between(u, sums[i]);
    value += asked * off * off;
    const Vec2 pull = 2 * weight * asked * off / length2 * perpendicular(u);
    gradient[i] -= pull;
    gradient[j] += pull;
  }
  return value;
}

std::vector<Vec2> asked_along(const Curve& curve, const DirectionField& field, double turn) {
  const double c = std::cos(turn), s = std::sin(turn);
  const double c2 = std::cos(2 * turn), s2 = std::sin(2 * turn);
  std::vector<Vec2> asked(curve.size(), Vec2(0, 0));
  for (std::size_t i = 0; i < curve.size(); ++i) {
    const Vec2 middle = (curve.vertices[i] + curve.vertices[curve.after(i)]) / 2;
    const Vec2 v = field.at({c * middle.x() + s * middle.y(), c * middle.y() - s * middle.x()});
    if (v.norm() >= least_field) asked[i] = {c2 * v.x() - s2 * v.y(), s2 * v.x() + c2 * v.y()};
  }
  return asked;
}

double alignment_along(const Curve& curve, const std::vector<Vec2>& asked, double width, double weight,
                       std::vector<Vec2>& gradient) {
  double value = 0;
  for (std::size_t i = 0; i < curve.size(); ++i) {
    const double strength = width * asked[i].norm();
    if (!(strength > 0)) continue;
    const std::size_t j = curve.after(i);
    const Vec2 u = curve.vertices[j] - curve.vertices[i];
    const double length = u.norm();
    if (!(length > 0)) continue;
    const double off = angle_between(u, asked[i]);
    value += strength * length * off * off;
    const Vec2 pull = weight * strength * off / length * (off * u + 2 * perpendicular(u));
    gradient[i] -= pull;
    gradient[j] += pull;
  }
  return value;
}

double mean_squared_angle(const Curve& curve, const DirectionField& field) {
  double sum = 0, length = 0;
  if (field.empty()) return 0;
  for (std::size_t i = 0; i < curve.size(); ++i) {
    const Vec2& a = curve.vertices[i];
    const Vec2 u = curve.vertices[curve.after(i)] - a;
    for (int k = 0; k < pieces; ++k) {
      const Vec2 v = field.at(a + (k + 0.5) / pieces * u);
      if (v.norm() < least_field) continue;
      const double off = angle_between(u, v);
      sum += u.norm() / pieces * off * off;
      length += u.norm() / pieces;
    }
  }
  return length > 0 ? sum / length : 0;
}

}  // namespace unicursal::core
