// Stretches of the borders between cells of the segment diagram. mm.
#pragma once

#include <vector>

#include "core/geometry/polygon.hpp"

namespace unicursal::core {

/// A stretch of a cell's border: a straight line, or a parabola over a directrix.
struct Arc {
  Vec2 from{0, 0}, to{0, 0};
  bool parabola = false;
  Vec2 base{0, 0}, along{0, 0}, focus{0, 0};  ///< parabola: a point and the unit direction of the directrix

  Vec2 at(double s) const { return parabola ? on_parabola(x_at(s)) : Vec2(from + s * (to - from)); }
  Vec2 derivative(double s) const {
    if (!parabola) return to - from;
    const Vec2 f = local(focus);
    const double slope = (x_at(s) - f.x()) / f.y();
    return (x_at(1) - x_at(0)) * (along + slope * perpendicular(along));
  }
  Vec2 local(const Vec2& p) const { return {(p - base).dot(along), (p - base).dot(perpendicular(along))}; }
  double x_at(double s) const {
    const double x0 = local(from).x(), x1 = local(to).x();
    return x0 + s * (x1 - x0);
  }
  Vec2 on_parabola(double x) const {
    const Vec2 f = local(focus);
    const double y = ((x - f.x()) * (x - f.x()) + f.y() * f.y()) / (2 * f.y());
    return base + x * along + y * perpendicular(along);
  }
};

/// Parameters in (0, 1) where an arc passes through a straight edge.
std::vector<double> crossings(const Arc& arc, const Vec2& a, const Vec2& b);

/// A box that holds the arc.
Box bounds(const Arc& arc);

}  // namespace unicursal::core
