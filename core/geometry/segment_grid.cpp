#include "core/geometry/segment_grid.hpp"

#include <cassert>

namespace unicursal::core {

SegmentGrid::SegmentGrid(const std::vector<Segment>& segments, double pitch) : pitch_(pitch) {
  assert(!segments.empty() && pitch > 0);
  Box box{segments[0].a, segments[0].a};
  for (const Segment& s : segments) {
    box.min = box.min.cwiseMin(s.a.cwiseMin(s.b));
    box.max = box.max.cwiseMax(s.a.cwiseMax(s.b));
  }
  const double most = 4.0 * static_cast<double>(segments.size()) + 1e4;
  pitch_ = std::max(pitch, std::sqrt(box.size().prod() / most));
  pitch_ = std::max(pitch_, box.size().maxCoeff() / most);
  origin_ = box.min;
  columns_ = static_cast<std::ptrdiff_t>(box.size().x() / pitch_) + 1;
  rows_ = static_cast<std::ptrdiff_t>(box.size().y() / pitch_) + 1;
  const auto each_square = [&](auto visit) {
    for (std::size_t s = 0; s < segments.size(); ++s) {
      const Vec2 low = segments[s].a.cwiseMin(segments[s].b), high = segments[s].a.cwiseMax(segments[s].b);
      for (std::ptrdiff_t r = row(low.y()); r <= row(high.y()); ++r) {
        for (std::ptrdiff_t c = column(low.x()); c <= column(high.x()); ++c) {
          visit(static_cast<std::size_t>(r * columns_ + c), s);
        }
      }
    }
  };
  start_.assign(static_cast<std::size_t>(columns_ * rows_) + 1, 0);
  each_square([&](std::size_t square, std::size_t) { ++start_[square + 1]; });
  for (std::size_t s = 1; s < start_.size(); ++s) start_[s] += start_[s - 1];
  entries_.resize(start_.back());
  std::vector<std::size_t> fill(start_.begin(), start_.end() - 1);
  each_square([&](std::size_t square, std::size_t s) { entries_[fill[square]++] = s; });
}

}  // namespace unicursal::core
