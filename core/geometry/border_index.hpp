// The border of a polygon in a uniform grid: fast answers to "inside?", "how far?" and "which edges are
// near?". Lengths in mm. Memory grows with the border's length and the polygon's box, not with the queries.
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
  std::size_t index = 0;  ///< of the edge in its ring; it leaves vertex `index`
};

class BorderIndex {
 public:
  /// `pitch` is the side of a grid square; about the size of the things that will be asked for.
  BorderIndex(const Polygon& polygon, double pitch);

  const std::vector<BorderEdge>& edges() const { return edges_; }
  /// Index of the first edge of a ring in `edges()`; rings follow one another.
  std::size_t first_edge(std::size_t ring) const { return first_edge_[ring]; }
  std::size_t ring_count() const { return first_edge_.size() - 1; }
  std::size_t ring_size(std::size_t ring) const { return first_edge_[ring + 1] - first_edge_[ring]; }

  /// Even-odd rule; points on the border may go either way.
  bool contains(const Vec2& point) const { return winding(point) % 2 != 0; }

  /// How often the rings run around a point, counter-clockwise: 1 inside and 0 outside of a sound polygon;
  /// anything where rounding let a border overlap itself. Summed over the plane it gives the signed area.
  int winding(const Vec2& point) const;

  /// Calls visit(edge number) at least once for every edge that meets the box; may repeat edges.
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

  /// Distance from a segment to the border, or `limit` when it is farther than that.
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
  std::vector<std::size_t> start_;     ///< per square, into entries_
  std::vector<std::size_t> entries_;   ///< edge numbers
  std::vector<std::int16_t> winding_;  ///< of each square's left lower corner
};

/// Distance between two closed segments, zero when they meet.
double distance_between_segments(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d);

}  // namespace unicursal::core
