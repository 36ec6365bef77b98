// The smallest sensible closed path: one round along the border, for islands too small for a cell graph.
#pragma once

#include <optional>

#include "core/curve/curve.hpp"
#include "core/geometry/polygon.hpp"

namespace unicursal::core {

/// Half a bead width inside the border, or as close to that as the island is wide; strictly inside and
/// simple, at least 5 vertices. Holes are passed on the inner side only if the offset merges with them.
/// Nothing when even a hair's breadth does not fit.
std::optional<Curve> contour(const Polygon& region, double bead_width);

}  // namespace unicursal::core
