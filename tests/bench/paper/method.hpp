// What every method of the comparison gets and gives: an island and a bead width, and the lines that fill it.
// mm, s.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/geometry/polygon.hpp"

namespace unicursal::bench {

/// A line that is laid in one go.
struct Line {
  std::vector<core::Vec2> points;
  bool closed = true;  ///< the last point is joined to the first

  std::size_t segments() const { return closed ? points.size() : points.size() - 1; }
  const core::Vec2& start(std::size_t i) const { return points[i]; }
  const core::Vec2& end(std::size_t i) const { return points[i + 1 < points.size() ? i + 1 : 0]; }
  double length(std::size_t i) const { return (end(i) - start(i)).norm(); }
};

/// The lines of one island in the order of laying; between two of them lies a travel.
struct Filling {
  std::vector<Line> lines;
  std::size_t iterations = 0;  ///< steps of an optimiser or of a growth; 0 if the method has none
  bool finished = true;        ///< false if a growth was given up before its stop criterion
};

}  // namespace unicursal::bench
