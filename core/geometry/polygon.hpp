// Points, rings and polygons with holes. All lengths in mm, areas in mm², angles in radians.
#pragma once

#include <cstddef>
#include <vector>

#include "core/numeric/vec2.hpp"

namespace unicursal::core {

/// A closed polygonal line; the last vertex is joined to the first and not repeated.
using Ring = std::vector<Vec2>;

/// A connected region of the plane. The outer ring runs counter-clockwise, holes clockwise.
struct Polygon {
  Ring outer;
  std::vector<Ring> holes;
};

struct Box {
  Vec2 min{0, 0};
  Vec2 max{0, 0};

  Vec2 size() const { return max - min; }
  Vec2 center() const { return (min + max) / 2; }
};

/// Signed: positive for counter-clockwise rings.
double signed_area(const Ring& ring);
/// The outer ring's area less that of the holes.
double area(const Polygon& polygon);
double area(const std::vector<Polygon>& polygons);
/// Length of the closed line.
double perimeter(const Ring& ring);
double perimeter(const Polygon& polygon);

/// Even-odd rule; points on the border may go either way.
bool contains(const Ring& ring, const Vec2& point);
bool contains(const Polygon& polygon, const Vec2& point);

/// The smallest box; precondition: at least one point.
Box bounds(const Ring& ring);
Box bounds(const Polygon& polygon);
Box bounds(const std::vector<Polygon>& polygons);

/// Distance from a point to a closed segment.
double distance_to_segment(const Vec2& point, const Vec2& a, const Vec2& b);
/// Distance from a point to the nearest border of the polygon, zero on it (brute force).
double distance_to_border(const Polygon& polygon, const Vec2& point);

}  // namespace unicursal::core
