// Boolean operations and offsets of regions, on a grid of 1e-6 mm (Clipper 6, Vatti's algorithm). A region is
// a list of disjoint polygons with holes. Results are oriented, have no slivers thinner than the grid, and
// their rings touch in single points at most (Clipper's stricter mode is slow and errs more often).
// Coordinates must stay within ±1e6 mm.
#pragma once

#include <vector>

#include "core/geometry/polygon.hpp"

namespace unicursal::core {

using Region = std::vector<Polygon>;

enum class FillRule { even_odd, non_zero };

/// The region that the rings together enclose.
Region enclosed(const std::vector<Ring>& rings, FillRule rule);

Region unite(const Region& a, const Region& b);
/// Unites all at once, which is much faster than one after another.
Region unite(const std::vector<const Region*>& regions);
Region intersect(const Region& a, const Region& b);
Region subtract(const Region& a, const Region& b);

/// The region grown by `distance` mm, or shrunk if negative. Corners are rounded, with an error of
/// `tolerance` mm.
Region offset(const Region& region, double distance, double tolerance);
/// The part of the region that a disc of radius `radius` inside it can reach (morphological opening).
Region opened(const Region& region, double radius, double tolerance);

/// The ring with fewer vertices. The old vertices are within `tolerance` mm of the new ring, which may leave
/// the old region by as much.
Ring simplified(const Ring& ring, double tolerance);
/// The same, but the new ring leaves the side that is to the left of the old one by no more than `beyond` mm.
Ring simplified_to_the_left(const Ring& ring, double tolerance, double beyond);

}  // namespace unicursal::core
