#include "core/curve/perimeters.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/curve/resample.hpp"

namespace unicursal::core {
namespace {

// In bead widths, or their squares.
constexpr double arc_tolerance = 0.005;  ///< of rounded offsets
constexpr double corner_radius = 0.1;    ///< of a ring's corners, and a fifth of what two strands keep apart
constexpr double least_left = 0.8;       ///< width of what is left to the fill; beads widen over the rest
constexpr double level_step = 0.05;      ///< between the distances at which thin places are followed
constexpr double narrow_share = 3;       ///< level steps: the radius below which centres belong to a level
constexpr double thin_area = 0.6;        ///< out of reach of a disc one bead in radius: more is no corner
constexpr double corner_spike = 0.12;    ///< thin and beyond the wide part's ring: less is a corner
constexpr double contact = 0.02;         ///< how near two areas touch
constexpr double pocket = 0.3;  ///< smaller holes of what a ring encloses, without reason, are closed
constexpr double bend = 0.005;  ///< that a simplified ring may move
constexpr double longest_segment = 2;
constexpr std::size_t fewest_vertices = 8;

Region rounded_corners(const Region& region, double radius, double w) {
  return offset(offset(region, -radius, arc_tolerance * w), radius, arc_tolerance * w);
}

std::size_t hole_count(const Region& region) {
  std::size_t count = 0;
  for (const Polygon& polygon : region) count += polygon.holes.size();
  return count;
}

/// Does a ring half a bead inside the border, `base`, not do?
bool has_thin_places(const Polygon& region, const Region& base, double w) {
  if (base.size() != 1 || hole_count(base) != region.holes.size()) return true;
  const Region thin = subtract({region}, opened({region}, w, arc_tolerance * w));
  return std::any_of(thin.begin(), thin.end(),
                     [&](const Polygon& piece) { return area(piece) > thin_area * w * w; });
}

/// Discs of half the radius of those that fill the thin places, on the same centres (the medial axis).
Region half_discs(const Polygon& region, double least_width, double w) {
  const double tolerance = arc_tolerance * w;
  std::vector<Region> levels;
  for (double depth = least_width / 4; depth < w / 2; depth += level_step * w) {
    const Region centres = offset({region}, -2 * depth, tolerance);
    const Region narrow = subtract(centres, opened(centres, narrow_share * level_step * w, tolerance));
    levels.push_back(offset(narrow, depth, tolerance));
  }
  std::vector<const Region*> all;
  for (const Region& level : levels) all.push_back(&level);
  return unite(all);
}

/// A thin place worth following: a spike that is no mere corner, or a neck between wide places.
bool worth_following(const Polygon& thin, const Region& base, double w) {
  if (area(thin) > corner_spike * w * w) return true;
  return intersect(offset({thin}, contact * w, arc_tolerance * w), base).size() > 1;
}

Region without_pockets(Region region, const Polygon& border, double w) {
  for (Polygon& polygon : region) {
    std::erase_if(polygon.holes, [&](const Ring& hole) {
      return std::abs(signed_area(hole)) < pocket * w * w &&
             std::none_of(border.holes.begin(), border.holes.end(),
                          [&](const Ring& real) { return contains(hole, real.front()); });
    });
  }
  return region;
}

Curve ring_curve(const Ring& ring, double w) {
  const Ring few = simplified(ring, bend * w);
  Curve curve;
  for (std::size_t i = 0; i < few.size(); ++i) {
    const Vec2 &a = few[i], &b = few[i + 1 < few.size() ? i + 1 : 0];
    const int pieces = std::max(1, static_cast<int>(std::ceil((b - a).norm() / (longest_segment * w))));
    for (int k = 0; k < pieces; ++k) curve.vertices.push_back(a + static_cast<double>(k) / pieces * (b - a));
  }
  while (curve.size() < fewest_vertices) curve = subdivided(curve);
  return curve;
}

std::vector<Curve> rings_of(const Region& region, double w) {
  std::vector<Curve> rings;
  for (const Polygon& polygon : region) {
    rings.push_back(ring_curve(polygon.outer, w));
    for (const Ring& hole : polygon.holes) rings.push_back(ring_curve(hole, w));
  }
  return rings;
}

}  // namespace

Region within_ring(const Polygon& region, double bead_width, double least_width) {
  const double w = bead_width, tolerance = arc_tolerance * w;
  const Region base = rounded_corners(offset({region}, -w / 2, tolerance), corner_radius * w, w);
  if (!has_thin_places(region, base, w)) return base;
  Region followed = base;
  for (const Polygon& thin : subtract(half_discs(region, least_width, w), base)) {
    if (worth_following(thin, base, w)) followed.push_back(thin);
  }
  // Grown a little they unite in spite of rounding; notches between them are closed on the way.
  const Region closed = offset(offset(followed, corner_radius * w, tolerance), -corner_radius * w, tolerance);
  return without_pockets(rounded_corners(closed, corner_radius * w, w), region, w);
}

Perimeters perimeters(const Polygon& region, int count, double bead_width, double least_width) {
  const double w = bead_width;
  Perimeters result;
  result.inside = {region};
  for (int k = 0; k < count && !result.inside.empty(); ++k) {
    std::vector<Curve> rings;
    Region left;
    for (const Polygon& piece : result.inside) {
      const Region within = within_ring(piece, w, k == 0 ? least_width : least_left * w);
      for (Curve& ring : rings_of(within, w)) rings.push_back(std::move(ring));
      if (within.empty()) continue;
      const Region next =
          opened(offset({piece}, -w, arc_tolerance * w), least_left * w / 2, arc_tolerance * w);
      left.insert(left.end(), next.begin(), next.end());
    }
    if (rings.empty()) break;
    result.rings.push_back(std::move(rings));
    result.inside = std::move(left);
  }
  return result;
}

}  // namespace unicursal::core
