#include "core/curve/perimeters.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "core/curve/resample.hpp"

namespace unicursal::core {
namespace {

// In bead widths, or their squares.
constexpr double arc_tolerance = 0.005;  ///< of rounded offsets
constexpr double corner_radius = 0.1;    ///< of a ring's corners, and a fifth of what two strands keep apart
constexpr double least_left = 0.8;       ///< width of what is left to the fill; beads widen over the rest
constexpr double level_step = 0.05;      ///< between the distances at which thin places are followed
constexpr double narrow_share = 2.5;     ///< level steps: the radius below which centres belong to a level
constexpr double half_level = 0.025;     ///< between a level's least and mean distance
constexpr double thin_reach = 0.95;      ///< radius of discs that do not reach into thin places
constexpr double thin_area = 0.6;        ///< out of their reach: more is no corner
constexpr double corner_spike = 0.02;    ///< of a thin place: less is a corner beside it
constexpr double hair = 0.02;            ///< half the width of differences that are rounding
constexpr double contact = 0.02;         ///< how near two areas touch
constexpr double notch = 0.13;           ///< half the width of notches that are closed
constexpr double small_area = 3, small_radius = 0.65;  ///< a piece of less is left to its neighbours
constexpr double shortest_ring = 2.5;                  ///< a shorter one could not be joined to others
constexpr double dust = 0.02;                          ///< smaller pieces and holes are rounding
constexpr double pocket = 0.3;  ///< smaller holes of what a ring encloses, without reason, are closed
constexpr double bend = 0.005;  ///< that a simplified ring may move
constexpr double shortest_segment = 0.02;
constexpr std::size_t fewest_vertices = 5;

/// Where a disc reaches: rounds corners. Unlike opened() it leaves no hairs where rounding differs.
Region disc_reach(const Region& region, double radius, double w) {
  return offset(offset(region, -radius, arc_tolerance * w), radius, arc_tolerance * w);
}

/// Rounding leaves hairs along edges, which link what is apart.
Region without_hairs(const Region& difference, double w) {
  return disc_reach(difference, hair * w, w);
}

/// What is narrower than two beads, corners aside.
Region thin_places(const Polygon& region, double w) {
  Region thin = without_hairs(subtract({region}, opened({region}, thin_reach * w, arc_tolerance * w)), w);
  std::erase_if(thin, [&](const Polygon& piece) { return area(piece) < thin_area * w * w; });
  return thin;
}

/// Offsets leave vertices a hair apart, sometimes backwards.
Ring without_crumbs(const Ring& ring, double least) {
  Ring result;
  for (const Vec2& v : ring) {
    if (result.empty() || (v - result.back()).norm() >= least) result.push_back(v);
  }
  while (result.size() > 3 && (result.back() - result.front()).norm() < least) result.pop_back();
  return result;
}

/// Offsets double the vertices of round borders again and again.
Region lean(Region region, double tolerance) {
  for (Polygon& polygon : region) {
    polygon.outer = simplified(without_crumbs(polygon.outer, tolerance), tolerance);
    for (Ring& hole : polygon.holes) hole = simplified(without_crumbs(hole, tolerance), tolerance);
  }
  return region;
}

/// Discs of half the radius of those that fill the thin places, on the same centres (the medial axis).
Region half_discs(const Region& region, double least_width, double w) {
  const double tolerance = arc_tolerance * w;
  std::vector<Region> levels;
  for (double depth = least_width / 4; depth < w / 2; depth += level_step * w) {
    const Region centres = lean(offset(region, -2 * depth, tolerance), tolerance);
    const Region narrow =
        without_hairs(subtract(centres, opened(centres, narrow_share * level_step * w, tolerance)), w);
    levels.push_back(offset(narrow, depth - half_level * w, tolerance));
  }
  std::vector<const Region*> all;
  for (const Region& level : levels) all.push_back(&level);
  return unite(all);
}

/// Is this a part of a thin place, or what links two wide places? Otherwise it reaches into a corner.
bool worth_following(const Polygon& discs, const Region& thin, const Region& wide, double w) {
  if (area(intersect({discs}, thin)) > corner_spike * w * w) return true;
  const Region grown = offset({discs}, contact * w, arc_tolerance * w);
  return std::count_if(wide.begin(), wide.end(),
                       [&](const Polygon& piece) { return !intersect(grown, {piece}).empty(); }) > 1;
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

Region without_dust(Region region, double w) {
  const double least = dust * w * w;
  std::erase_if(region, [&](const Polygon& piece) { return area(piece) < least; });
  for (Polygon& piece : region)
    std::erase_if(piece.holes, [&](const Ring& hole) { return -signed_area(hole) < least; });
  return region;
}

Curve ring_curve(const Ring& ring, double w) {
  Curve curve{simplified(without_crumbs(ring, shortest_segment * w), bend * w)};
  while (curve.size() < fewest_vertices) curve = subdivided(curve);
  return curve;
}

std::vector<Curve> rings_of(const Region& region, double w) {
  std::vector<Curve> rings;
  for (const Polygon& polygon : region) {
    if (perimeter(polygon.outer) < shortest_ring * w) continue;
    rings.push_back(ring_curve(polygon.outer, w));
    for (const Ring& hole : polygon.holes) rings.push_back(ring_curve(hole, w));
  }
  return rings;
}

}  // namespace

bool worth_a_curve(const Polygon& piece, double bead_width) {
  const double w = bead_width;
  return area(piece) > small_area * w * w || !offset({piece}, -small_radius * w, arc_tolerance * w).empty();
}

Region within_ring(const Polygon& region, double bead_width, double least_width) {
  const double w = bead_width, tolerance = arc_tolerance * w;
  const Region base = disc_reach(offset({region}, -w / 2, tolerance), corner_radius * w, w);
  const Region thin = thin_places(region, w);
  if (thin.empty() && base.size() == 1) return without_pockets(base, region, w);
  Region followed = base;
  for (const Polygon& discs : subtract(half_discs({region}, least_width, w), base)) {
    if (worth_following(discs, thin, base, w)) followed.push_back(discs);
  }
  // Grown a little they unite in spite of rounding; notches between them are closed on the way.
  const Region closed = offset(offset(followed, notch * w, tolerance), -notch * w, tolerance);
  return without_dust(without_pockets(disc_reach(closed, corner_radius * w, w), region, w), w);
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
      const Region reached = disc_reach(offset({piece}, -w, arc_tolerance * w), least_left * w / 2, w);
      const Region next = lean(without_dust(reached, w), arc_tolerance * w);
      std::copy_if(next.begin(), next.end(), std::back_inserter(left),
                   [&](const Polygon& rest) { return worth_a_curve(rest, w); });
    }
    if (rings.empty()) break;
    result.rings.push_back(std::move(rings));
    result.inside = std::move(left);
  }
  return result;
}

}  // namespace unicursal::core
