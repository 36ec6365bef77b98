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
constexpr double corner_radius = 0.1;    ///< of a ring's corners; a fifth of the distance between two strands
constexpr double least_left = 0.8;   ///< least width of the area left to the fill; wider beads cover the rest
constexpr double level_step = 0.05;  ///< between the levels (distances from the border) in thin places
constexpr double narrow_share = 2.5;   ///< level steps; centres in places of smaller radius belong to a level
constexpr double half_level = 0.025;   ///< difference between a level's mean and least distance
constexpr double thin_reach = 0.95;    ///< radius of discs that do not reach into thin places
constexpr double thin_area = 0.6;      ///< an area out of their reach that is smaller is a corner
constexpr double corner_spike = 0.02;  ///< a smaller part of a thin place is a corner beside it
constexpr double hair = 0.02;          ///< half the width of differences that are rounding
constexpr double contact = 0.02;       ///< areas at this distance count as touching
constexpr double notch = 0.13;         ///< half the width of notches that are closed
constexpr double small_area = 3, small_radius = 0.65;  ///< a smaller piece is covered by its neighbours
constexpr double shortest_ring = 2.5;                  ///< a shorter ring could not be joined to others
constexpr double dust = 0.02;                          ///< smaller pieces and holes are rounding
constexpr double pocket = 0.3;  ///< smaller holes inside a ring that contain no hole of the region are closed
constexpr double bend = 0.005;  ///< how far simplification may move a ring
constexpr double shortest_segment = 0.02;
constexpr std::size_t fewest_vertices = 5;

/// The part of a region that a disc reaches, with rounded corners. Unlike opened(), this leaves no hairs
/// where rounding differs.
Region disc_reach(const Region& region, double radius, double w) {
  return offset(offset(region, -radius, arc_tolerance * w), radius, arc_tolerance * w);
}

/// Removes hairs along edges, which rounding leaves and which would connect separate areas.
Region without_hairs(const Region& difference, double w) {
  return disc_reach(difference, hair * w, w);
}

/// The places narrower than two beads, without corners.
Region thin_parts(const Polygon& region, double w) {
  Region thin = without_hairs(subtract({region}, opened({region}, thin_reach * w, arc_tolerance * w)), w);
  std::erase_if(thin, [&](const Polygon& piece) { return area(piece) < thin_area * w * w; });
  return thin;
}

/// Removes vertices that offsets leave very close to each other, sometimes in reverse order.
Ring without_short_edges(const Ring& ring, double least) {
  Ring result;
  for (const Vec2& v : ring) {
    if (result.empty() || (v - result.back()).norm() >= least) result.push_back(v);
  }
  while (result.size() > 3 && (result.back() - result.front()).norm() < least) result.pop_back();
  return result;
}

/// Removes superfluous vertices: every offset doubles the vertices of round borders.
Region lean(Region region, double tolerance) {
  for (Polygon& polygon : region) {
    polygon.outer = simplified(without_short_edges(polygon.outer, tolerance), tolerance);
    for (Ring& hole : polygon.holes) hole = simplified(without_short_edges(hole, tolerance), tolerance);
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

/// Whether the discs lie in a thin place or connect two wide places. Otherwise they reach into a corner.
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
  Curve curve{simplified(without_short_edges(ring, shortest_segment * w), bend * w)};
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
  const Region thin = thin_parts(region, w);
  if (thin.empty() && base.size() == 1) return without_pockets(base, region, w);
  Region followed = base;
  for (const Polygon& discs : subtract(half_discs({region}, least_width, w), base)) {
    if (worth_following(discs, thin, base, w)) followed.push_back(discs);
  }
  // A little growth unites them in spite of rounding, and closes notches between them.
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
