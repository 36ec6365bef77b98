#include "firmware_gcode/route/detour.hpp"

#include <algorithm>
#include <limits>

namespace unicursal::gcode {
namespace {

constexpr double clearance = 1.0;          ///< mm between the travel and an outline
constexpr double longest_factor = 1.5;     ///< times the straight way
constexpr double longest_more = 10;        ///< mm in addition
constexpr std::size_t most_corners = 400;  ///< of all obstacles; with more, the travel is straight
constexpr double touch = 1e-6;             ///< mm; grazing a hull does not cross it

using Hull = core::Ring;

/// Counter-clockwise, by Andrew's monotone chain.
Hull convex_hull(core::Ring points) {
  std::sort(points.begin(), points.end(), [](const core::Vec2& a, const core::Vec2& b) {
    return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
  });
  Hull hull;
  const auto extend = [&hull](const core::Vec2& p, std::size_t least) {
    while (hull.size() >= least + 2 &&
           core::cross(hull.back() - hull[hull.size() - 2], p - hull.back()) <= 0) {
      hull.pop_back();
    }
    hull.push_back(p);
  };
  for (const core::Vec2& p : points) extend(p, 0);
  const std::size_t lower = hull.size() - 1;
  for (auto p = points.rbegin() + 1; p < points.rend(); ++p) extend(*p, lower);
  if (hull.size() > 1) hull.pop_back();
  return hull;
}

/// The convex hull plus the clearance: every corner is replaced by a small octagon.
Hull grown(const core::Ring& ring) {
  constexpr double side = 0.41421356237309503;  // tan of an eighth turn
  core::Ring points;
  for (const core::Vec2& p : convex_hull(ring)) {
    for (const double a : {-1.0, 1.0}) {
      for (const double b : {-side, side}) {
        points.push_back(p + clearance * core::Vec2(a, b));
        points.push_back(p + clearance * core::Vec2(b, a));
      }
    }
  }
  return convex_hull(std::move(points));
}

bool inside(const Hull& hull, const core::Vec2& p) {
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const core::Vec2& a = hull[i];
    const core::Vec2& b = hull[(i + 1) % hull.size()];
    if (core::cross(b - a, p - a) < touch * (b - a).norm()) return false;
  }
  return true;
}

/// Returns whether a part of the segment lies inside the hull; clips it by the half-planes of all sides.
bool crosses(const Hull& hull, const core::Vec2& from, const core::Vec2& to) {
  double begin = 0, end = 1;
  for (std::size_t i = 0; i < hull.size() && begin < end; ++i) {
    const core::Vec2& a = hull[i];
    const core::Vec2 side = hull[(i + 1) % hull.size()] - a;
    const double at_from = core::cross(side, from - a) - touch * side.norm();
    const double at_to = core::cross(side, to - a) - touch * side.norm();
    if (at_from <= 0 && at_to <= 0) return false;
    if (at_from < 0) begin = std::max(begin, at_from / (at_from - at_to));
    if (at_to < 0) end = std::min(end, at_from / (at_from - at_to));
  }
  return begin < end;
}

class Ways {
 public:
  Ways(const core::Vec2& from, const core::Vec2& to, std::vector<Hull> hulls, const core::Box& within)
      : hulls_(std::move(hulls)), nodes_{from, to} {
    for (const Hull& hull : hulls_) {
      for (const core::Vec2& p : hull) {
        const bool on_bed = (p - within.min).minCoeff() >= 0 && (within.max - p).minCoeff() >= 0;
        const bool free =
            std::none_of(hulls_.begin(), hulls_.end(), [&](const Hull& h) { return inside(h, p); });
        if (on_bed && free) nodes_.push_back(p);
      }
    }
  }

  bool free(const core::Vec2& a, const core::Vec2& b) const {
    return std::none_of(hulls_.begin(), hulls_.end(), [&](const Hull& hull) { return crosses(hull, a, b); });
  }

  /// Dijkstra's algorithm from the first node to the second. Returns the nodes in between; empty if the way
  /// is too long.
  std::vector<core::Vec2> shortest(double longest) const {
    std::vector<double> way(nodes_.size(), std::numeric_limits<double>::infinity());
    std::vector<std::size_t> before(nodes_.size(), 0);
    std::vector<bool> done(nodes_.size(), false);
    way[0] = 0;
    for (;;) {
      std::size_t here = nodes_.size();
      for (std::size_t i = 0; i < nodes_.size(); ++i) {
        if (!done[i] && way[i] <= longest && (here == nodes_.size() || way[i] < way[here])) here = i;
      }
      if (here == nodes_.size()) return {};
      if (here == 1) break;
      done[here] = true;
      for (std::size_t i = 0; i < nodes_.size(); ++i) {
        const double more = way[here] + (nodes_[i] - nodes_[here]).norm();
        if (done[i] || more >= way[i] || more > longest || !free(nodes_[here], nodes_[i])) continue;
        way[i] = more, before[i] = here;
      }
    }
    std::vector<core::Vec2> via;
    for (std::size_t i = before[1]; i != 0; i = before[i]) via.push_back(nodes_[i]);
    std::reverse(via.begin(), via.end());
    return via;
  }

 private:
  std::vector<Hull> hulls_;
  std::vector<core::Vec2> nodes_;
};

}  // namespace

std::vector<core::Vec2> detour(const core::Vec2& from, const core::Vec2& to,
                               const std::vector<core::Polygon>& outlines, const core::Box& within) {
  const double longest = longest_factor * (to - from).norm() + longest_more;
  std::vector<Hull> hulls;
  std::size_t corners = 0;
  const auto consider = [&](const core::Ring& ring) {
    if (ring.size() < 3) return;
    Hull hull = grown(ring);
    if (inside(hull, from) || inside(hull, to)) return;
    corners += hull.size();
    hulls.push_back(std::move(hull));
  };
  for (const core::Polygon& outline : outlines) {
    consider(outline.outer);
    for (const core::Ring& hole : outline.holes) consider(hole);
  }
  const bool straight =
      std::none_of(hulls.begin(), hulls.end(), [&](const Hull& hull) { return crosses(hull, from, to); });
  if (straight || corners > most_corners) return {};
  return Ways(from, to, std::move(hulls), within).shortest(longest);
}

}  // namespace unicursal::gcode
