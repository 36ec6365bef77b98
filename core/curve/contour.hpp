// The simplest closed path: once around along the border, for islands too small for a cell graph.
#pragma once

#include <optional>

#include "core/curve/curve.hpp"
#include "core/geometry/polygon.hpp"

namespace unicursal::core {

/// A contour half a bead width inside the border, or nearer to the border if the island is too narrow for
/// that. It is simple, strictly inside, and has at least 5 vertices. A hole is respected only where the
/// offset outline merges with it. Returns nullopt if no contour fits.
std::optional<Curve> contour(const Polygon& region, double bead_width);

}  // namespace unicursal::core
