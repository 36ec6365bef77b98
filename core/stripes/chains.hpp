// Loops as chains of points at equal distances, and what it costs to leave the field on the way from one to
// another. mm, radians.
#pragma once

#include <cstddef>
#include <vector>

#include "core/curve/curve.hpp"
#include "core/field/direction_field.hpp"

namespace unicursal::core {

/// The points of all loops, loop by loop.
struct Chains {
  double step = 0;  ///< about the distance between two points
  std::vector<Vec2> points;
  std::vector<std::size_t> loops;          ///< per point
  std::vector<std::size_t> after, before;  ///< neighbours along the curve
  std::vector<double> off;                 ///< per point: off_field() on the way to the next

  std::size_t size() const { return points.size(); }
};

/// `smoothing` steps round off the corners of the loops.
Chains chains_of(const std::vector<Curve>& loops, const DirectionField& field, double step, int smoothing);

/// ∫ (angle to the field)² ds along a straight line, rad²·mm.
double off_field(const Vec2& a, const Vec2& b, const DirectionField& field, double step);

}  // namespace unicursal::core
