#include "core/geometry/diagram_arc.hpp"

#include <cmath>

namespace unicursal::core {

Arc line(const Vec2& from, const Vec2& to) {
  return {from, (from + to) / 2, to};
}

Arc parabola(const Vec2& from, const Vec2& to, const Vec2& focus, const Vec2& base, const Vec2& along) {
  const Vec2 up = perpendicular(along);
  const double height = (focus - base).dot(up);
  const double x0 = (from - focus).dot(along), x1 = (to - focus).dot(along);
  // The tangents at both ends meet in the point that is equally far from the focus and from the feet of both
  // ends.
  const double y = (height + x0 * x1 / height) / 2;
  const Vec2 control = focus + (x0 + x1) / 2 * along + (y - height) * up;
  return control.allFinite() ? Arc{from, control, to} : line(from, to);
}

std::vector<double> crossings(const Arc& arc, const Vec2& a, const Vec2& b) {
  std::vector<double> found;
  const double length = (b - a).norm();
  const auto keep = [&](double s) {
    if (!(s > 0 && s < 1)) return;
    const double along = (arc.at(s) - a).dot(b - a) / length;
    if (along > -rounding_slack && along < length + rounding_slack) found.push_back(s);
  };
  // n·(point − a) = 0 along the arc is a quadratic in s.
  const Vec2 n = perpendicular(b - a);
  const double h0 = n.dot(arc.from - a), h1 = n.dot(arc.control - a), h2 = n.dot(arc.to - a);
  const double q2 = h0 - 2 * h1 + h2, q1 = 2 * (h1 - h0);
  const double discriminant = q1 * q1 - 4 * q2 * h0;
  if (discriminant < 0) return found;
  const double q = -0.5 * (q1 + std::copysign(std::sqrt(discriminant), q1));
  if (q2 != 0) keep(q / q2);
  if (q != 0) keep(h0 / q);
  return found;
}

Box bounds(const Arc& arc) {
  const Vec2 margin(rounding_slack, rounding_slack);
  return {arc.from.cwiseMin(arc.to).cwiseMin(arc.control) - margin,
          arc.from.cwiseMax(arc.to).cwiseMax(arc.control) + margin};
}

}  // namespace unicursal::core
