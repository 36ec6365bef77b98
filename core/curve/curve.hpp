// A closed polygonal curve, mm. Vertex i is followed by vertex i + 1, and the last vertex by the first.
#pragma once

#include <cstddef>
#include <vector>

#include "core/geometry/polygon.hpp"
#include "core/geometry/segment.hpp"

namespace unicursal::core {

struct Curve {
  std::vector<Vec2> vertices;

  std::size_t size() const { return vertices.size(); }
  std::size_t after(std::size_t i) const { return i + 1 < vertices.size() ? i + 1 : 0; }
  std::size_t before(std::size_t i) const { return i > 0 ? i - 1 : vertices.size() - 1; }
  double length() const { return perimeter(vertices); }
  /// All segments; segment i leaves vertex i.
  std::vector<Segment> segments() const { return segments_of(vertices); }
};

}  // namespace unicursal::core
