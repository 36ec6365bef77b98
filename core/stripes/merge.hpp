// Loops of stripes become one closed curve: exchanges of arcs (exchanges.hpp), cheapest first, each between
// two sets of loops that are not connected yet (Kruskal). mm.
#pragma once

#include <cstdint>
#include <vector>

#include "core/curve/curve.hpp"
#include "core/field/direction_field.hpp"
#include "core/geometry/polygon.hpp"

namespace unicursal::core {

/// The curves that remain, normally one. Preconditions: the loops are simple, disjoint, inside the region and
/// turned alike (zero_lines.hpp). `smoothing` steps round off their corners first. The result need not be
/// simple where loops come very near to each other.
std::vector<Curve> merged(const std::vector<Curve>& loops, const Polygon& region, const DirectionField& field,
                          double bead_width, int smoothing, std::uint64_t seed);

}  // namespace unicursal::core
