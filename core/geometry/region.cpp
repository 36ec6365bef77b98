#include "core/geometry/region.hpp"

#include <cmath>
#include <cstdint>
#include <functional>
#include <polyclipping/clipper.hpp>
#include <utility>

#include "core/stopping.hpp"

namespace unicursal::core {
namespace {

constexpr double grid = 1e6;             ///< grid steps per mm
constexpr double vertices_in_reach = 4;  ///< in the first step of an offset, along a straight border
constexpr double between_steps = 0.1;    ///< of the tolerance: how much a step but the last may simplify

ClipperLib::Path to_path(const Ring& ring) {
  ClipperLib::Path path;
  path.reserve(ring.size());
  for (const Vec2& p : ring) {
    path.emplace_back(static_cast<ClipperLib::cInt>(std::llround(p.x() * grid)),
                      static_cast<ClipperLib::cInt>(std::llround(p.y() * grid)));
  }
  return path;
}

ClipperLib::Paths to_paths(const Region& region) {
  ClipperLib::Paths paths;
  for (const Polygon& polygon : region) {
    paths.push_back(to_path(polygon.outer));
    for (const Ring& hole : polygon.holes) paths.push_back(to_path(hole));
  }
  return paths;
}

Ring to_ring(const ClipperLib::Path& path, bool counter_clockwise) {
  Ring ring;
  ring.reserve(path.size());
  for (const ClipperLib::IntPoint& p : path) {
    ring.emplace_back(static_cast<double>(p.X) / grid, static_cast<double>(p.Y) / grid);
  }
  if ((signed_area(ring) > 0) != counter_clockwise) ring = Ring(ring.rbegin(), ring.rend());
  return ring;
}

void collect(const ClipperLib::PolyNode& parent, Region& region) {
  for (const ClipperLib::PolyNode* outer : parent.Childs) {
    if (outer->Contour.size() < 3) continue;
    Polygon polygon{to_ring(outer->Contour, true), {}};
    for (const ClipperLib::PolyNode* hole : outer->Childs) {
      if (hole->Contour.size() >= 3) polygon.holes.push_back(to_ring(hole->Contour, false));
      collect(*hole, region);
    }
    region.push_back(std::move(polygon));
  }
}

Region to_region(const ClipperLib::PolyTree& tree) {
  Region region;
  collect(tree, region);
  return region;
}

Region combine(const Region& a, const Region& b, ClipperLib::ClipType type) {
  stop_point();
  ClipperLib::Clipper clipper;
  clipper.AddPaths(to_paths(a), ClipperLib::ptSubject, true);
  clipper.AddPaths(to_paths(b), ClipperLib::ptClip, true);
  ClipperLib::PolyTree tree;
  clipper.Execute(type, tree, ClipperLib::pftNonZero, ClipperLib::pftNonZero);
  return to_region(tree);
}

Region offset_once(const Region& region, double distance, double tolerance) {
  stop_point();
  ClipperLib::ClipperOffset shifter(2.0, tolerance * grid);
  shifter.AddPaths(to_paths(region), ClipperLib::jtRound, ClipperLib::etClosedPolygon);
  ClipperLib::PolyTree tree;
  shifter.Execute(tree, distance * grid);
  return to_region(tree);
}

/// mm between vertices, if the border were as long as that of the region's box.
double vertex_distance(const Region& region) {
  std::size_t vertices = 0;
  for (const Polygon& polygon : region) {
    vertices += polygon.outer.size();
    for (const Ring& hole : polygon.holes) vertices += hole.size();
  }
  return vertices > 0 ? 2 * bounds(region).size().sum() / static_cast<double>(vertices) : 0.0;
}

void simplify(Polygon& polygon, double tolerance) {
  polygon.outer = simplified(polygon.outer, tolerance);
  for (Ring& hole : polygon.holes) hole = simplified(hole, tolerance);
}

}  // namespace

Region enclosed(const std::vector<Ring>& rings, FillRule rule) {
  stop_point();
  ClipperLib::Clipper clipper;
  for (const Ring& ring : rings) clipper.AddPath(to_path(ring), ClipperLib::ptSubject, true);
  const auto fill = rule == FillRule::even_odd ? ClipperLib::pftEvenOdd : ClipperLib::pftNonZero;
  ClipperLib::PolyTree tree;
  clipper.Execute(ClipperLib::ctUnion, tree, fill, fill);
  return to_region(tree);
}

Region unite(const std::vector<const Region*>& regions) {
  std::vector<Ring> rings;
  for (const Region* region : regions) {
    for (const Polygon& polygon : *region) {
      rings.push_back(polygon.outer);
      rings.insert(rings.end(), polygon.holes.begin(), polygon.holes.end());
    }
  }
  return enclosed(rings, FillRule::non_zero);
}

Region unite(const Region& a, const Region& b) {
  return combine(a, b, ClipperLib::ctUnion);
}
Region intersect(const Region& a, const Region& b) {
  return combine(a, b, ClipperLib::ctIntersection);
}
Region subtract(const Region& a, const Region& b) {
  return combine(a, b, ClipperLib::ctDifference);
}

Region offset(const Region& region, double distance, double tolerance) {
  // Clipper's time grows with the square of the number of vertices within reach. Growing steps keep that
  // number small: the first steps remove the detail that would slow down the later ones.
  Region result = region;
  double left = std::abs(distance);
  for (double step = vertices_in_reach * vertex_distance(region); step > 0 && left > 2 * step; step *= 2) {
    result = offset_once(result, std::copysign(step, distance), tolerance);
    for (Polygon& polygon : result) simplify(polygon, between_steps * tolerance);
    left -= step;
  }
  return offset_once(result, std::copysign(left, distance), tolerance);
}

Region opened(const Region& region, double radius, double tolerance) {
  return intersect(offset(offset(region, -radius, tolerance), radius, tolerance), region);
}

namespace {

/// How far a ring's vertex is from its place if the ring runs from `a` to `b` instead, as a share of what is
/// allowed there.
using Excess = std::function<double(const Vec2& vertex, const Vec2& a, const Vec2& b)>;

Ring without_unimportant(const Ring& ring, const Excess& excess) {
  if (ring.size() <= 4) return ring;
  // Douglas and Peucker (1973) on the two halves between the first vertex and the one farthest from it.
  std::vector<bool> keep(ring.size() + 1, false);
  std::size_t far = 0;
  for (std::size_t i = 1; i < ring.size(); ++i) {
    if ((ring[i] - ring[0]).squaredNorm() > (ring[far] - ring[0]).squaredNorm()) far = i;
  }
  const auto at = [&](std::size_t i) -> const Vec2& { return ring[i < ring.size() ? i : 0]; };
  keep[0] = keep[far] = true;
  std::vector<std::pair<std::size_t, std::size_t>> spans{{0, far}, {far, ring.size()}};
  while (!spans.empty()) {
    const auto [first, last] = spans.back();
    spans.pop_back();
    double worst = 1;
    std::size_t split = first;
    for (std::size_t i = first + 1; i < last; ++i) {
      const double e = excess(at(i), at(first), at(last));
      if (e > worst) worst = e, split = i;
    }
    if (split == first) continue;
    keep[split] = true;
    spans.push_back({first, split});
    spans.push_back({split, last});
  }
  Ring result;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    if (keep[i]) result.push_back(ring[i]);
  }
  return result.size() >= 3 ? result : ring;
}

}  // namespace

Ring simplified(const Ring& ring, double tolerance) {
  return without_unimportant(ring, [tolerance](const Vec2& vertex, const Vec2& a, const Vec2& b) {
    return distance_to_segment(vertex, a, b) / tolerance;
  });
}

Ring simplified_to_the_left(const Ring& ring, double tolerance, double beyond) {
  return without_unimportant(ring, [tolerance, beyond](const Vec2& vertex, const Vec2& a, const Vec2& b) {
    const bool left = cross(b - a, vertex - a) > 0;
    return distance_to_segment(vertex, a, b) / (left ? beyond : tolerance);
  });
}

}  // namespace unicursal::core
