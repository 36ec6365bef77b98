// Computes exactly how much of every grid square a region covers. It is the transpose of the field's integral
// under an edge (direction_field.hpp): there an edge gathers from the squares below it, here it gives to
// them.
#pragma once

#include <vector>

#include "core/field/grid.hpp"
#include "core/geometry/region.hpp"

namespace unicursal::core {

/// Per square: the covered share of its area, 0…1. Parts of the region outside the grid are ignored.
std::vector<double> cover(const Grid& grid, const Region& region);

}  // namespace unicursal::core
