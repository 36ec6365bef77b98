#include "core/geometry/diagram_arc.hpp"

#include <cmath>

namespace unicursal::core {

std::vector<double> crossings(const Arc& arc, const Vec2& a, const Vec2& b) {
  std::vector<double> found;
  const auto keep = [&](double s) {
    if (!(s > 0 && s < 1)) return;
    const Vec2 p = arc.at(s);
    const double tau = (p - a).dot(b - a) / (b - a).squaredNorm();
    if (tau >= 0 && tau < 1) found.push_back(s);
  };
  if (!arc.parabola) {
    const double slope = cross(arc.to - arc.from, b - a);
    if (slope != 0) keep(cross(a - arc.from, b - a) / slope);
    return found;
  }
  // n·(point − a) = 0 along the parabola is a quadratic in x.
  const Vec2 f = arc.local(arc.focus), la = arc.local(a), lb = arc.local(b);
  const Vec2 n = perpendicular(lb - la);
  const double q2 = n.y() / (2 * f.y()), q1 = n.x() - n.y() * f.x() / f.y();
  const double q0 = n.y() * (f.squaredNorm() / (2 * f.y())) - n.dot(la);
  const double x0 = arc.x_at(0), x1 = arc.x_at(1);
  const double discriminant = q1 * q1 - 4 * q2 * q0;
  if (discriminant < 0 || x0 == x1) return found;
  const double q = -0.5 * (q1 + std::copysign(std::sqrt(discriminant), q1));
  if (q2 != 0) keep((q / q2 - x0) / (x1 - x0));
  if (q != 0) keep((q0 / q - x0) / (x1 - x0));
  return found;
}

Box bounds(const Arc& arc) {
  Box box{arc.from.cwiseMin(arc.to), arc.from.cwiseMax(arc.to)};
  if (arc.parabola) {
    // A parabola stays within the triangle of its ends and the meeting point of their tangents.
    const Vec2 apex = arc.from + arc.derivative(0) / 2;
    box.min = box.min.cwiseMin(apex);
    box.max = box.max.cwiseMax(apex);
  }
  return box;
}

}  // namespace unicursal::core
