#include "core/geometry/segment_rows.hpp"

namespace unicursal::core {
namespace {

constexpr double longest = 2;  ///< squares; longer segments are kept in their own list
/// Of the largest side, so that thin boxes do not have too many squares.
constexpr double least_pitch = 1e-3;
constexpr double least_square = 1e-9;  ///< mm

}  // namespace

SegmentRows::SegmentRows(const std::vector<Segment>& segments) {
  start_.assign(2, 0);
  if (segments.empty()) return;
  Box box{segments[0].a, segments[0].a};
  double length = 0;
  for (const Segment& s : segments) {
    box.min = box.min.cwiseMin(s.a.cwiseMin(s.b));
    box.max = box.max.cwiseMax(s.a.cwiseMax(s.b));
    length += (s.b - s.a).norm();
  }
  const auto count = static_cast<double>(segments.size());
  pitch_ = std::max({length / count, std::sqrt(box.size().prod() / count),
                     std::min(least_pitch, 1 / count) * box.size().maxCoeff(), least_square});
  origin_ = box.min;
  columns_ = static_cast<std::ptrdiff_t>(box.size().x() / pitch_) + 1;
  rows_ = static_cast<std::ptrdiff_t>(box.size().y() / pitch_) + 1;
  start_.assign(static_cast<std::size_t>(columns_ * rows_) + 1, 0);
  const auto square = [this](const Segment& s) {
    const Vec2 middle = (s.a + s.b) / 2;
    return static_cast<std::size_t>(row(middle.y()) * columns_ + column(middle.x()));
  };
  const auto is_long = [this](const Segment& s) {
    return (s.b - s.a).squaredNorm() > longest * longest * pitch_ * pitch_;
  };
  for (const Segment& s : segments) {
    if (!is_long(s)) ++start_[square(s) + 1];
  }
  for (std::size_t k = 1; k < start_.size(); ++k) start_[k] += start_[k - 1];
  order_.resize(start_.back());
  std::vector<std::size_t> next(start_.begin(), start_.end() - 1);
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const auto index = static_cast<std::int32_t>(i);
    if (is_long(segments[i])) {
      longer_.push_back(index);
    } else {
      order_[next[square(segments[i])]++] = index;
    }
  }
}

}  // namespace unicursal::core
