// Where a piece of the segment diagram lies in its island. mm.
#pragma once

#include "core/geometry/border_index.hpp"

namespace unicursal::core {

/// How a piece was cut out of the island.
struct Frame {
  const BorderIndex* island = nullptr;
  Box lines;     ///< the lines that bound the piece; infinite on sides that were not cut
  Box searched;  ///< all segments that meet this box were found

  static bool level(const Vec2& a, const Vec2& b, Eigen::Index k, double line) {
    return a[k] == line && b[k] == line;
  }
  /// Whether the edge a b runs along one of the lines.
  bool on_line(const Vec2& a, const Vec2& b) const {
    return level(a, b, 0, lines.min.x()) || level(a, b, 0, lines.max.x()) || level(a, b, 1, lines.min.y()) ||
           level(a, b, 1, lines.max.y());
  }
  /// Whether the edge a b runs along a line, and `p` lies on the same line.
  bool on_line(const Vec2& a, const Vec2& b, const Vec2& p) const {
    return on_line(a, b) && (a.x() == b.x() ? p.x() == a.x() : p.y() == a.y());
  }
};

}  // namespace unicursal::core
