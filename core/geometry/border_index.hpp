// The border of a polygon in a uniform grid, for fast queries: is a point inside, how far is the border,
// which edges are near? Lengths in mm. Memory grows with the length of the border and the area of its box.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/geometry/polygon.hpp"

namespace unicursal::core {

/// One straight edge of the border, with the polygon's inside on its left.
struct BorderEdge {
  Vec2 a, b;
  std::size_t ring = 0;   ///< 0 is the outer ring, then the holes in order
  std::size_t index = 0;  ///< of the vertex in the ring at which the edge starts
};

class BorderIndex {
 public:
  /// `pitch` is the side of a grid square, best about the size of the queried segments and boxes.
  BorderIndex(const Polygon& polygon, double pitch);

  const std::vector<BorderEdge>& edges() const { return edges_; }
  /// Index in `edges()` of the first edge of a ring; rings follow one another.
  std::size_t first_edge(std::size_t ring) const { return first_edge_[ring]; }
  std::size_t ring_count() const { return first_edge_.size() - 1; }
  std::size_t ring_size(std::size_t ring) const { return first_edge_[ring + 1] - first_edge_[ring]; }

  /// Even-odd rule; points on the border may go either way.
  bool contains(const Vec2& point) const { return winding(point) % 2 != 0; }

  /// How often the rings run around a point, counter-clockwise: 1 inside and 0 outside a sound polygon, any
  /// number where rounding has made the border overlap itself. The integral over the plane is the signed
  /// area.
  int winding(const Vec2& point) const;

  /// Calls visit(edge index) at least once for every edge that meets the box; may repeat edges.
  template <typename Visit>
  void near(const Box& box, Visit visit) const {
    const Range r = range(box);
    for (std::ptrdiff_t row = r.row0; row <= r.row1; ++row) {
      for (std::ptrdiff_t column = r.column0; column <= r.column1; ++column) {
        const std::size_t square = static_cast<std::size_t>(row * columns_ + column);
        for (std::size_t k = start_[square]; k < start_[square + 1]; ++k) visit(entries_[k]);
      }
    }
  }

  /// Distance from a segment to the border, at most `limit`.
  double distance(const Vec2& a, const Vec2& b, double limit) const;

 private:
  struct Range {
    std::ptrdiff_t row0, row1, column0, column1;
  };
  Range range(const Box& box) const;
  std::ptrdiff_t column_of(double x) const;
  std::ptrdiff_t row_of(double y) const;

  std::vector<BorderEdge> edges_;
  std::vector<std::size_t> first_edge_;
  Vec2 origin_{0, 0};
  double pitch_;
  std::ptrdiff_t columns_ = 1, rows_ = 1;
  std::vector<std::size_t> start_;     ///< per square: where its edges begin in entries_
  std::vector<std::size_t> entries_;   ///< edge indices, square by square
  std::vector<std::int16_t> winding_;  ///< per square: winding number of its lower left corner
};

/// Distance between two closed segments; zero if they meet.
double distance_between_segments(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d);

}  // namespace unicursal::core
