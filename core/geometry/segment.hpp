// A straight stretch between two points, mm.
#pragma once

#include <cstddef>
#include <vector>

#include "core/geometry/polygon.hpp"

namespace unicursal::core {

struct Segment {
  Vec2 a{0, 0}, b{0, 0};  ///< equal for a point
};

/// The sides of a ring: segment i runs from vertex i to its successor.
inline std::vector<Segment> segments_of(const Ring& ring) {
  std::vector<Segment> segments(ring.size());
  for (std::size_t i = 0; i < ring.size(); ++i)
    segments[i] = {ring[i], ring[i + 1 < ring.size() ? i + 1 : 0]};
  return segments;
}

}  // namespace unicursal::core
