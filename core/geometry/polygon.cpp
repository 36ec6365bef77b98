#include "core/geometry/polygon.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace unicursal::core {

double signed_area(const Ring& ring) {
  if (ring.size() < 3) return 0;
  double twice = 0;
  const Vec2 origin = ring.front();
  for (std::size_t i = 1; i + 1 < ring.size(); ++i) twice += cross(ring[i] - origin, ring[i + 1] - origin);
  return twice / 2;
}

double area(const Polygon& polygon) {
  double sum = std::abs(signed_area(polygon.outer));
  for (const Ring& hole : polygon.holes) sum -= std::abs(signed_area(hole));
  return sum;
}

double area(const std::vector<Polygon>& polygons) {
  double sum = 0;
  for (const Polygon& polygon : polygons) sum += area(polygon);
  return sum;
}

double perimeter(const Ring& ring) {
  if (ring.empty()) return 0;
  double sum = (ring.front() - ring.back()).norm();
  for (std::size_t i = 0; i + 1 < ring.size(); ++i) sum += (ring[i + 1] - ring[i]).norm();
  return sum;
}

double perimeter(const Polygon& polygon) {
  double sum = perimeter(polygon.outer);
  for (const Ring& hole : polygon.holes) sum += perimeter(hole);
  return sum;
}

bool contains(const Ring& ring, const Vec2& point) {
  bool inside = false;
  for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
    const Vec2 &a = ring[i], &b = ring[j];
    if ((a.y() > point.y()) != (b.y() > point.y()) &&
        point.x() < (b.x() - a.x()) * (point.y() - a.y()) / (b.y() - a.y()) + a.x()) {
      inside = !inside;
    }
  }
  return inside;
}

bool contains(const Polygon& polygon, const Vec2& point) {
  if (!contains(polygon.outer, point)) return false;
  return std::none_of(polygon.holes.begin(), polygon.holes.end(),
                      [&](const Ring& hole) { return contains(hole, point); });
}

Box bounds(const Ring& ring) {
  assert(!ring.empty());
  Box box{ring.front(), ring.front()};
  for (const Vec2& p : ring) {
    box.min = box.min.cwiseMin(p);
    box.max = box.max.cwiseMax(p);
  }
  return box;
}

Box bounds(const Polygon& polygon) {
  return bounds(polygon.outer);
}

Box bounds(const std::vector<Polygon>& polygons) {
  assert(!polygons.empty());
  Box box = bounds(polygons.front());
  for (const Polygon& polygon : polygons) {
    const Box other = bounds(polygon);
    box.min = box.min.cwiseMin(other.min);
    box.max = box.max.cwiseMax(other.max);
  }
  return box;
}

double distance_to_segment(const Vec2& point, const Vec2& a, const Vec2& b) {
  const Vec2 ab = b - a;
  const double length2 = ab.squaredNorm();
  const double t = length2 > 0 ? std::clamp((point - a).dot(ab) / length2, 0.0, 1.0) : 0.0;
  return (point - a - t * ab).norm();
}

double distance_to_border(const Polygon& polygon, const Vec2& point) {
  double best = std::numeric_limits<double>::infinity();
  const auto visit = [&](const Ring& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      best = std::min(best, distance_to_segment(point, ring[i], ring[(i + 1) % ring.size()]));
    }
  };
  visit(polygon.outer);
  for (const Ring& hole : polygon.holes) visit(hole);
  return best;
}

}  // namespace unicursal::core
