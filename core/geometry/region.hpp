// Boolean operations and offsets of regions, on a grid of 1e-6 mm (Clipper 6, Vatti's algorithm).
// A region is a list of disjoint polygons with holes; results are tidy: oriented, no slivers below the
// grid, rings that at most touch in single points (Clipper's stricter mode is slow and errs more often).
// Coordinates must stay within ±1e6 mm.
#pragma once

#include <vector>

#include "core/geometry/polygon.hpp"

namespace unicursal::core {

using Region = std::vector<Polygon>;

enum class FillRule { even_odd, non_zero };

/// The region that the rings enclose together.
Region enclosed(const std::vector<Ring>& rings, FillRule rule);

Region unite(const Region& a, const Region& b);
/// All at once, which takes far less time than one after another.
Region unite(const std::vector<const Region*>& regions);
Region intersect(const Region& a, const Region& b);
Region subtract(const Region& a, const Region& b);

/// Grown by `distance` mm (shrunk when negative), corners rounded to `tolerance` mm.
Region offset(const Region& region, double distance, double tolerance);
/// What a disc of radius `radius` that stays inside the region can reach (morphological opening).
Region opened(const Region& region, double radius, double tolerance);

/// Fewer vertices: none is farther than `tolerance` mm from the old border; may leave the region by as much.
Ring simplified(const Ring& ring, double tolerance);

}  // namespace unicursal::core
