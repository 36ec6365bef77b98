// Large islands are divided along lines, and each piece gets its own part of the segment diagram. mm.
#pragma once

#include "core/geometry/border_index.hpp"

namespace unicursal::core {

/// Where a piece lies in its island.
struct Frame {
  const BorderIndex* island = nullptr;
  Box lines;     ///< the lines at which the piece was cut off; infinite on sides where it was not
  Box searched;  ///< the box that was searched for segments

  static bool level(const Vec2& a, const Vec2& b, Eigen::Index k, double line) {
    return a[k] == line && b[k] == line;
  }
  bool on_line(const Vec2& a, const Vec2& b) const {
    return level(a, b, 0, lines.min.x()) || level(a, b, 0, lines.max.x()) || level(a, b, 1, lines.min.y()) ||
           level(a, b, 1, lines.max.y());
  }
  /// Whether a, b and p lie on the same of these lines.
  bool on_line(const Vec2& a, const Vec2& b, const Vec2& p) const {
    return on_line(a, b) && (a.x() == b.x() ? p.x() == a.x() : p.y() == a.y());
  }
};

}  // namespace unicursal::core
