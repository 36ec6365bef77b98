// The vertices and open segments of a closed curve as the sites of a Voronoi diagram, and which of them is
// nearest to a point. mm.
#pragma once

#include <compare>
#include <cstddef>
#include <vector>

#include "core/geometry/polygon.hpp"
#include "core/geometry/segment.hpp"
#include "core/geometry/segment_grid.hpp"

namespace unicursal::core {

/// A vertex of the curve, or the open segment that leaves it.
struct CurveSite {
  std::size_t index = 0;
  bool segment = false;
  friend auto operator<=>(const CurveSite&, const CurveSite&) = default;
};

class CurveSites {
 public:
  /// Keeps a reference to the ring.
  explicit CurveSites(const Ring& ring);

  const Ring& curve() const { return curve_; }
  std::size_t size() const { return curve_.size(); }
  /// About the length of a segment.
  double pitch() const { return pitch_; }

  std::size_t after(std::size_t vertex) const { return (vertex + 1) % curve_.size(); }
  std::size_t before(std::size_t vertex) const { return (vertex + curve_.size() - 1) % curve_.size(); }
  const Segment& segment(std::size_t index) const { return segments_[index]; }
  /// The unit vector along a segment.
  Vec2 direction(std::size_t segment) const {
    return (segments_[segment].b - segments_[segment].a).normalized();
  }
  bool ends_in(std::size_t segment, std::size_t vertex) const {
    return segment == vertex || after(segment) == vertex;
  }

  /// Where the foot of `p` lies on a segment's line: 0 at its start, 1 at its end.
  double along(std::size_t segment, const Vec2& p) const {
    const Vec2 d = segments_[segment].b - segments_[segment].a;
    return (p - segments_[segment].a).dot(d) / d.squaredNorm();
  }
  Vec2 nearest_point(const CurveSite& site, const Vec2& p) const;
  CurveSite nearest(const Vec2& p) const;

  /// Segments whose boxes meet a box, ascending.
  std::vector<std::size_t> segments_near(const Box& box) const;

 private:
  const Ring& curve_;
  double pitch_;
  std::vector<Segment> segments_;
  SegmentGrid grid_;
};

}  // namespace unicursal::core
