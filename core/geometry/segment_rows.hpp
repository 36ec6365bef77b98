// Segments sorted by the grid square of their midpoint, row by row. The segments near a place are then a few
// runs of neighbouring entries, with each segment once. Segments much longer than a square are kept in a list
// of their own. mm.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/geometry/segment.hpp"

namespace unicursal::core {

class SegmentRows {
 public:
  /// The squares are about as large as a segment's share of the box, or as long as the mean segment.
  explicit SegmentRows(const std::vector<Segment>& segments);

  /// Indices of segments, square by square.
  const std::vector<std::int32_t>& order() const { return order_; }
  /// Indices of the long segments, which are in no square.
  const std::vector<std::int32_t>& longer() const { return longer_; }
  /// No point of a segment in a square is farther from its midpoint than this, mm.
  double half_length() const { return pitch_; }

  std::ptrdiff_t column(double x) const { return bucket(x - origin_.x(), columns_); }
  std::ptrdiff_t row(double y) const { return bucket(y - origin_.y(), rows_); }
  /// Where the entries of a square begin in `order`; they end where those of the next square begin, also
  /// across rows.
  std::size_t begin(std::ptrdiff_t row, std::ptrdiff_t column) const {
    return start_[static_cast<std::size_t>(row * columns_ + column)];
  }
  std::size_t end(std::ptrdiff_t row, std::ptrdiff_t column) const { return begin(row, column + 1); }

 private:
  std::ptrdiff_t bucket(double offset, std::ptrdiff_t count) const {
    return static_cast<std::ptrdiff_t>(
        std::clamp(std::floor(offset / pitch_), 0.0, static_cast<double>(count - 1)));
  }

  Vec2 origin_{0, 0};
  double pitch_ = 1;
  std::ptrdiff_t columns_ = 1, rows_ = 1;
  std::vector<std::size_t> start_;
  std::vector<std::int32_t> order_, longer_;
};

}  // namespace unicursal::core
