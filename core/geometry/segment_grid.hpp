// Segments in a uniform grid, to find those near each other. mm.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/geometry/segment.hpp"

namespace unicursal::core {

class SegmentGrid {
 public:
  /// `pitch` mm is the side of a square. Precondition: not empty.
  SegmentGrid(const std::vector<Segment>& segments, double pitch);

  /// Calls visit(index) at least once for every segment whose box meets the box; may repeat.
  template <typename Visit>
  void near(const Box& box, Visit visit) const {
    const std::ptrdiff_t c0 = column(box.min.x()), c1 = column(box.max.x());
    for (std::ptrdiff_t r = row(box.min.y()), r1 = row(box.max.y()); r <= r1; ++r) {
      // The squares of a row follow one another, and so do their entries.
      const auto first = static_cast<std::size_t>(r * columns_ + c0),
                 last = static_cast<std::size_t>(r * columns_ + c1);
      for (std::size_t k = start_[first]; k < start_[last + 1]; ++k) visit(entries_[k]);
    }
  }

 private:
  std::ptrdiff_t column(double x) const { return bucket(x - origin_.x(), columns_); }
  std::ptrdiff_t row(double y) const { return bucket(y - origin_.y(), rows_); }
  std::ptrdiff_t bucket(double offset, std::ptrdiff_t count) const {
    return static_cast<std::ptrdiff_t>(
        std::clamp(std::floor(offset / pitch_), 0.0, static_cast<double>(count - 1)));
  }

  Vec2 origin_{0, 0};
  double pitch_;
  std::ptrdiff_t columns_ = 1, rows_ = 1;
  std::vector<std::size_t> start_;
  std::vector<std::size_t> entries_;
};

}  // namespace unicursal::core
