#include "core/geometry/curve_sites.hpp"

#include <algorithm>
#include <limits>

namespace unicursal::core {

CurveSites::CurveSites(const Ring& ring)
    : curve_(ring),
      pitch_(1.5 * perimeter(ring) / static_cast<double>(ring.size())),
      segments_(segments_of(ring)),
      grid_(segments_, pitch_) {}

Vec2 CurveSites::nearest_point(const CurveSite& site, const Vec2& p) const {
  if (!site.segment) return curve_[site.index];
  const Segment& s = segments_[site.index];
  return s.a + std::clamp(along(site.index, p), 0.0, 1.0) * (s.b - s.a);
}

CurveSite CurveSites::nearest(const Vec2& p) const {
  double best = std::numeric_limits<double>::infinity();
  std::size_t index = 0;
  for (double reach = pitch_, searched = 0; !(best <= searched); searched = reach, reach *= 2) {
    const Vec2 margin(reach, reach);
    grid_.near({p - margin, p + margin}, [&](std::size_t i) {
      const double d = distance_to_segment(p, segments_[i].a, segments_[i].b);
      if (d < best) best = d, index = i;
    });
  }
  const double t = along(index, p);
  if (t > 0 && t < 1) return {index, true};
  // At a vertex both of its segments are equally near, except for rounding.
  const std::size_t next = after(index), previous = before(index);
  if (t <= 0) return along(previous, p) < 1 ? CurveSite{previous, true} : CurveSite{index, false};
  return along(next, p) > 0 ? CurveSite{next, true} : CurveSite{next, false};
}

std::vector<std::size_t> CurveSites::segments_near(const Box& box) const {
  std::vector<std::size_t> found;
  grid_.near(box, [&](std::size_t i) {
    const Segment& s = segments_[i];
    if ((s.a.cwiseMin(s.b).array() <= box.max.array()).all() &&
        (s.a.cwiseMax(s.b).array() >= box.min.array()).all())
      found.push_back(i);
  });
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

}  // namespace unicursal::core
