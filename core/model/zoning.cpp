#include "core/model/zoning.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace unicursal::core {
namespace {

constexpr double half_weld = weld_width / 2;  ///< mm, radius of the disc that cannot enter slivers
constexpr double rounding = weld_width / 10;  ///< mm, tolerance of that disc's arcs
constexpr double smoothing = weld_width / 2;  ///< mm, how far a border may move to lose unimportant vertices
constexpr double outwards = 1e-5;             ///< mm, how far an outline may do so: a few steps of the grid
constexpr double overlap = 3e-6;              ///< mm, a few steps of the grid, so that patches really overlap
constexpr double dust_area = speck_area * 1e-4;  ///< mm², pieces left by rounding on the grid

using Claims = std::map<std::size_t, Region>;

bool overlapping(const Box& a, const Box& b) {
  return (a.min.array() <= b.max.array()).all() && (b.min.array() <= a.max.array()).all();
}

Region near(const Region& region, const Box& box) {
  Region result;
  std::copy_if(region.begin(), region.end(), std::back_inserter(result),
               [&](const Polygon& polygon) { return overlapping(bounds(polygon), box); });
  return result;
}

bool is_sliver(const Polygon& polygon) {
  // A place that the disc cannot enter has less area than a strip of the disc's width along its border.
  if (area(polygon) > weld_width * perimeter(polygon)) return false;
  return offset({polygon}, -half_weld, rounding).empty();
}

void report_unclaimed(const Region& visible, const std::string& label, std::vector<Unclaimed>& unclaimed) {
  for (const Polygon& piece : opened(visible, half_weld, rounding)) {
    if (area(piece) > speck_area) unclaimed.push_back({label, piece.outer.front(), area(piece)});
  }
}

/// The gaps that a disc of half the weld's width cannot enter from outside.
Region gaps_in(const Region& region) {
  const Region closed = offset(offset(region, half_weld + overlap, rounding), -half_weld - overlap, rounding);
  Region gaps = subtract(closed, region);
  // The disc also leaves a fillet in every corner; fillets are short.
  std::erase_if(gaps, [](const Polygon& gap) { return bounds(gap).size().norm() < 2 * weld_width; });
  return gaps;
}

/// Whether two polygons are so close that a weld may join them.
bool nearly_touching(const Region& region) {
  std::vector<Box> boxes;
  for (const Polygon& polygon : region) {
    boxes.push_back(bounds(polygon));
    boxes.back().max += Vec2::Constant(weld_width);
  }
  std::sort(boxes.begin(), boxes.end(), [](const Box& a, const Box& b) { return a.min.x() < b.min.x(); });
  for (auto a = boxes.begin(); a != boxes.end(); ++a) {
    for (auto b = a + 1; b != boxes.end() && b->min.x() <= a->max.x(); ++b) {
      if (overlapping(*a, *b)) return true;
    }
  }
  return false;
}

/// Simplification always keeps the first vertex.
Ring from_extreme(Ring ring) {
  const auto extreme = std::min_element(ring.begin(), ring.end(), [](const Vec2& a, const Vec2& b) {
    return std::pair(a.x(), a.y()) < std::pair(b.x(), b.y());
  });
  std::rotate(ring.begin(), extreme, ring.end());
  return ring;
}

/// Removes the tiny steps that overlapping outlines, welds and facets leave in borders. `beyond` mm: how far
/// the result may leave the region.
Region smooth_region(const Region& region, double beyond) {
  std::vector<Ring> rings;
  const auto add = [&](Ring ring, bool outer) {
    if ((signed_area(ring) > 0) != outer)
      std::reverse(ring.begin(), ring.end());  // the region is to its left
    rings.push_back(simplified_to_the_left(from_extreme(std::move(ring)), smoothing, beyond));
  };
  for (const Polygon& polygon : region) {
    add(polygon.outer, true);
    for (const Ring& hole : polygon.holes) add(hole, false);
  }
  return enclosed(rings, FillRule::even_odd);
}

/// The outline with its gaps closed and few vertices. Only where a gap is closed, the new border may run a
/// little outside of the old one, or notches would stay at the gap's ends.
Region mended(const Region& whole, const Region& gaps) {
  if (gaps.empty()) return smooth_region(whole, outwards);
  const Region welded = unite(whole, offset(gaps, overlap, rounding));
  const Region around = offset(gaps, weld_width, rounding);
  return smooth_region(intersect(smooth_region(welded, smoothing), unite(welded, around)), outwards);
}

void remove_specks(Region& region) {
  const auto is_speck = [](const Ring& ring) { return std::abs(signed_area(ring)) < speck_area; };
  std::erase_if(region, [&](const Polygon& polygon) { return is_speck(polygon.outer); });
  for (Polygon& polygon : region) std::erase_if(polygon.holes, is_speck);
}

/// The areas of the zones inside one island, without slivers, which any neighbour may take.
std::vector<ZoneRegion> local_claims(const Polygon& outline, const Claims& claims) {
  std::vector<ZoneRegion> result;
  const Box box = bounds(outline);
  for (const auto& [zone, claim] : claims) {
    Region local = near(claim, box);
    if (local.empty()) continue;
    local = intersect(local, {outline});
    std::erase_if(local, is_sliver);
    local = smooth_region(local, smoothing);
    if (!local.empty()) result.push_back({zone, std::move(local)});
  }
  return result;
}

/// Gives a leftover piece to the zone that it touches most.
void give(const Polygon& piece, std::vector<ZoneRegion>& zones) {
  const Region reach = offset({piece}, half_weld, rounding);
  std::vector<double> touch;
  for (const ZoneRegion& zone : zones)
    touch.push_back(area(intersect(near(zone.polygons, bounds(reach)), reach)));
  ZoneRegion& taker = zones[std::size_t(std::max_element(touch.begin(), touch.end()) - touch.begin())];
  taker.polygons = unite(taker.polygons, {piece});
}

/// Lets each zone grow by the weld width into areas of no zone, so that together they cover the outline.
std::vector<ZoneRegion> grown_together(const Polygon& outline, const std::vector<ZoneRegion>& claims) {
  std::vector<ZoneRegion> result;
  Region free{outline};
  for (std::size_t i = 0; i < claims.size(); ++i) {
    Region mine = intersect(free, offset(claims[i].polygons, weld_width, rounding));
    for (std::size_t j = i + 1; j < claims.size(); ++j) mine = subtract(mine, claims[j].polygons);
    free = subtract(free, mine);
    if (!mine.empty()) result.push_back({claims[i].zone, std::move(mine)});
  }
  for (const Polygon& piece : free) {
    if (area(piece) > dust_area) give(piece, result);
  }
  return result;
}

using Reflection = Eigen::Matrix2d;

Ring reflected(const Ring& ring, const Reflection& map) {
  Ring result;
  for (auto p = ring.rbegin(); p != ring.rend(); ++p) result.push_back(map * *p);
  return result;
}

Polygon reflected(const Polygon& polygon, const Reflection& map) {
  Polygon result{reflected(polygon.outer, map), {}};
  for (const Ring& hole : polygon.holes) result.holes.push_back(reflected(hole, map));
  return result;
}

std::vector<ZoneRegion> reflected(std::vector<ZoneRegion> zones, const Reflection& map) {
  for (ZoneRegion& zone : zones) {
    for (Polygon& polygon : zone.polygons) polygon = reflected(polygon, map);
  }
  return zones;
}

double mismatch(const Polygon& outline, const std::vector<ZoneRegion>& zones) {
  double sum = -area(outline);
  for (const ZoneRegion& zone : zones) sum += area(zone.polygons);
  return std::abs(sum);
}

/// Clipper's sweep sometimes assigns a hole that touches another ring to the wrong one (about once in a
/// hundred piles of near copies). The areas reveal it, and a sweep along another axis does not err at the
/// same place. Reflections along axes and diagonals are exact.
std::vector<ZoneRegion> covering(const Polygon& outline, const std::vector<ZoneRegion>& claims) {
  constexpr double tolerance = 1e-7;  // of the outline's area
  std::vector<ZoneRegion> best = grown_together(outline, claims);
  const Reflection swap{{0, 1}, {1, 0}}, flip{{1, 0}, {0, -1}}, both{{0, -1}, {-1, 0}};
  for (const Reflection& map : {swap, flip, both}) {
    if (mismatch(outline, best) <= tolerance * area(outline)) break;
    auto other = reflected(grown_together(reflected(outline, map), reflected(claims, map)), map);
    if (mismatch(outline, other) < mismatch(outline, best)) best = std::move(other);
  }
  return best;
}

std::optional<Island> island(Polygon outline, const Claims& claims) {
  std::vector<ZoneRegion> local = local_claims(outline, claims);
  if (local.empty()) return std::nullopt;
  if (local.size() == 1) {
    local.front().polygons = {outline};
  } else {
    local = covering(outline, local);
  }
  return Island{std::move(outline), std::move(local)};
}

}  // namespace

Zoning zoned(const std::vector<Painted>& shapes) {
  Zoning result;
  Claims claims;
  Region whole;
  for (auto shape = shapes.rbegin(); shape != shapes.rend();) {
    // Neighbours in the pile that belong to the same zone can be united.
    const auto first = shape;
    std::vector<const Region*> pile{&(shape++)->region};
    while (first->zone && shape != shapes.rend() && shape->zone == first->zone)
      pile.push_back(&(shape++)->region);
    const Region painted = pile.size() > 1 ? unite(pile) : first->region;
    const Region visible = subtract(painted, whole);
    whole = unite(whole, painted);
    if (first->zone) {
      claims[*first->zone] = unite(claims[*first->zone], visible);
    } else {
      report_unclaimed(visible, first->label, result.unclaimed);
    }
  }
  const bool may_have_gaps = shapes.size() > 1 || nearly_touching(whole);
  whole = mended(whole, may_have_gaps ? gaps_in(whole) : Region{});
  remove_specks(whole);
  for (Polygon& outline : whole) {
    if (auto made = island(std::move(outline), claims)) result.islands.push_back(std::move(*made));
  }
  std::stable_sort(result.islands.begin(), result.islands.end(),
                   [](const Island& a, const Island& b) { return area(a.outline) > area(b.outline); });
  std::stable_sort(result.unclaimed.begin(), result.unclaimed.end(),
                   [](const Unclaimed& a, const Unclaimed& b) { return a.area > b.area; });
  return result;
}

}  // namespace unicursal::core
