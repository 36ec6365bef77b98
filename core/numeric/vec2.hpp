// Points and vectors of the plane.
#pragma once

#include <Eigen/Core>

namespace unicursal::core {

using Vec2 = Eigen::Vector2d;

/// The z component of the cross product; positive when b lies counter-clockwise of a.
inline double cross(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// A quarter turn counter-clockwise.
inline Vec2 perpendicular(const Vec2& v) {
  return {-v.y(), v.x()};
}

}  // namespace unicursal::core
