#include "core/thin/thin_places.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "core/geometry/segment.hpp"

namespace unicursal::core {
namespace {

// A smaller thick piece, in areas of the disc that just fits into a thin place, belongs to its neighbours.
constexpr double least_thick = 2.5;
// In bead widths.
constexpr double arc_tolerance = 0.005;  ///< of rounded offsets
constexpr double hair = 0.02;            ///< half the width of differences that are rounding
constexpr double depth_step = 0.5;       ///< between the points of its border that are looked at
constexpr double least_depth = 1.0;   ///< a thin place that reaches less far out of a thick one is a corner
constexpr double thick_reach = 0.65;  ///< by how much a larger disc must fit into a small thick piece

/// The part of a region that a disc reaches, without the hairs along edges that rounding leaves.
Region disc_reach(const Region& region, double radius, double w) {
  return offset(offset(region, -radius, arc_tolerance * w), radius, arc_tolerance * w);
}

/// How far a piece reaches out of the thick places.
double depth(const Polygon& piece, const Region& thick, double w) {
  double deepest = 0;
  for (const Segment& side : segments_of(piece.outer)) {
    const double pieces = std::ceil((side.b - side.a).norm() / (depth_step * w));
    for (double k = 0; k < pieces; ++k) {
      const Vec2 p = side.a + k / pieces * (side.b - side.a);
      double nearest = std::numeric_limits<double>::infinity();
      for (const Polygon& polygon : thick) nearest = std::min(nearest, distance_to_border(polygon, p));
      deepest = std::max(deepest, nearest);
    }
  }
  return deepest;
}

}  // namespace

ThinPlaces thin_places(const Polygon& region, double bead_width, double width) {
  const double w = bead_width;
  const Region wide = opened({region}, width / 2, arc_tolerance * w);
  ThinPlaces places;
  if (wide.empty()) return {{region}, {}};
  for (Polygon& piece : disc_reach(subtract({region}, wide), hair * w, w)) {
    if (depth(piece, wide, w) > least_depth * w) places.thin.push_back(std::move(piece));
  }
  if (places.thin.empty()) return {{}, {region}};
  places.thick =
      disc_reach(subtract({region}, offset(places.thin, hair * w, arc_tolerance * w)), hair * w, w);
  const std::size_t all = places.thick.size();
  const double disc = std::numbers::pi / 4 * width * width;
  std::erase_if(places.thick, [&](const Polygon& piece) {
    return area(piece) < least_thick * disc &&
           offset({piece}, -width / 2 - thick_reach * w, arc_tolerance * w).empty();
  });
  if (places.thick.size() < all) {
    places.thin = {region};
    if (!places.thick.empty()) {
      places.thin =
          disc_reach(subtract(places.thin, offset(places.thick, hair * w, arc_tolerance * w)), hair * w, w);
    }
  }
  return places;
}

}  // namespace unicursal::core
