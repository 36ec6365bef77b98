// Joins curves that run side by side into one closed curve (paper §3.1, zoning; end of §4.2, perimeters).
//
// Departure from the paper, which counts crossings of zone borders among the objectives of a random search
// (55): here every piece of a material zone gets its own closed curve, and neighbours are joined at one place
// each. The closed curve through k pieces then crosses borders 2 (k − 1) times, which is the least possible
// number.
#pragma once

#include <optional>
#include <vector>

#include "core/curve/curve.hpp"
#include "core/curve/joints.hpp"
#include "core/geometry/polygon.hpp"

namespace unicursal::core {

/// One curve through all curves: where two run side by side, a stretch of about a bead width is taken out of
/// both, and the ends are joined by bridges. Returns nullopt if some curve cannot be reached without touching
/// another strand or the island's border. Preconditions: the curves are simple, disjoint and inside `island`.
std::optional<Curve> joined(std::vector<Curve> curves, const Polygon& island, double bead_width,
                            const JointPrice& price = {});

}  // namespace unicursal::core
