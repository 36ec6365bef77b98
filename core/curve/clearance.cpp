#include "core/curve/clearance.hpp"

#include <algorithm>

#include "core/geometry/segment_grid.hpp"
#include "core/graph/voronoi.hpp"

namespace unicursal::core {
namespace {

constexpr double safe_share = 0.45;  ///< of a clearance that either side may use up; below one half

std::vector<Segment> segments_of(const Curve& curve) {
  std::vector<Segment> segments(curve.size());
  for (std::size_t i = 0; i < curve.size(); ++i)
    segments[i] = {curve.vertices[i], curve.vertices[curve.after(i)]};
  return segments;
}

double mean_length(const std::vector<Segment>& segments) {
  double sum = 0;
  for (const Segment& s : segments) sum += (s.b - s.a).norm();
  return sum / static_cast<double>(segments.size());
}

bool neighbours(const Curve& curve, std::size_t i, std::size_t j) {
  return i == j || curve.after(i) == j || curve.after(j) == i;
}

/// Closed segments, exact: do they share a point?
bool meet(const Segment& s, const Segment& t) {
  const int a = orientation(s.a, s.b, t.a), b = orientation(s.a, s.b, t.b);
  const int c = orientation(t.a, t.b, s.a), d = orientation(t.a, t.b, s.b);
  if (a * b > 0 || c * d > 0) return false;
  if (a == 0 && b == 0) {  // on one line: do their boxes overlap?
    const Vec2 low = s.a.cwiseMin(s.b).cwiseMax(t.a.cwiseMin(t.b)),
               high = s.a.cwiseMax(s.b).cwiseMin(t.a.cwiseMax(t.b));
    return (low.array() <= high.array()).all();
  }
  return true;
}

}  // namespace

std::vector<double> freedom(const Curve& curve, const BorderIndex& border, double reach,
                            const Margins& margins) {
  const std::vector<Segment> segments = segments_of(curve);
  const SegmentGrid grid(segments, reach);
  std::vector<double> clear(segments.size(), reach);
  const Vec2 margin = (reach + margins.self) * Vec2(1, 1);
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const Segment& s = segments[i];
    const Vec2 low = s.a.cwiseMin(s.b), high = s.a.cwiseMax(s.b);
    grid.near({low - margin, high + margin}, [&](std::size_t j) {
      if (j <= i || neighbours(curve, i, j)) return;
      const Segment& t = segments[j];
      const double limit = std::max(clear[i], clear[j]);
      const Vec2 gap = (low - t.a.cwiseMax(t.b)).cwiseMax(t.a.cwiseMin(t.b) - high);
      if (gap.maxCoeff() >= limit + margins.self) return;
      const double d = std::max(distance_between_segments(s.a, s.b, t.a, t.b) - margins.self, 0.0);
      clear[i] = std::min(clear[i], d);
      clear[j] = std::min(clear[j], d);
    });
    const double to_border = border.distance(s.a, s.b, clear[i] + margins.border) - margins.border;
    clear[i] = std::clamp(to_border, 0.0, clear[i]);
  }
  std::vector<double> result(curve.size());
  for (std::size_t i = 0; i < curve.size(); ++i) {
    result[i] = safe_share * std::min(clear[i], clear[curve.before(i)]);
  }
  return result;
}

std::size_t self_intersections(const Curve& curve) {
  if (curve.size() < 4) return 0;
  const std::vector<Segment> segments = segments_of(curve);
  const SegmentGrid grid(segments, std::max(mean_length(segments), 1e-9));
  std::size_t count = 0;
  std::vector<std::size_t> seen(segments.size(), segments.size());
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const Segment& s = segments[i];
    grid.near({s.a.cwiseMin(s.b), s.a.cwiseMax(s.b)}, [&](std::size_t j) {
      if (j <= i || seen[j] == i || neighbours(curve, i, j)) return;
      seen[j] = i;
      if (meet(s, segments[j])) ++count;
    });
  }
  return count;
}

std::size_t segments_outside(const Curve& curve, const BorderIndex& border) {
  std::size_t count = 0;
  for (const Segment& s : segments_of(curve)) {
    bool bad = !border.contains(s.a);
    border.near({s.a.cwiseMin(s.b), s.a.cwiseMax(s.b)}, [&](std::size_t e) {
      bad = bad || meet(s, {border.edges()[e].a, border.edges()[e].b});
    });
    if (bad) ++count;
  }
  return count;
}

}  // namespace unicursal::core
