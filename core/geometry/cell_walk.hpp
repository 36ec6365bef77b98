// Second part of the segment diagram: the walk along the borders of all cells, clipped by one piece of the
// island. Its stretches are added to the cells' integrals. mm.
#pragma once

#include <vector>

#include "core/geometry/cell_integrals.hpp"
#include "core/geometry/diagram_frame.hpp"
#include "core/geometry/piece_diagram.hpp"

namespace unicursal::core {

/// Adds the parts of the cells inside `piece` to `cells`. `borders` are those of the segments that meet
/// frame.searched. Returns by how many mm segments should have been searched farther away: if the result is
/// positive, a circle around some point of the piece that reaches to the nearest of these segments leaves the
/// searched box, so that the cells may not be those of the whole curve.
double walk_cells(const CurveSites& sites, const std::vector<CellBorder>& borders, const Frame& frame,
                  const Polygon& piece, CellSums& cells);

}  // namespace unicursal::core
