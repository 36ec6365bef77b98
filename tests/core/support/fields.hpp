// Fields of directions for tests. mm, radians.
#pragma once

#include <cstddef>
#include <vector>

#include "core/field/direction_field.hpp"

namespace unicursal::core::test {

/// The field whose direction at every point is `angle(point)`, with squares of `pitch` mm.
template <typename Angle>
DirectionField field_of(const Polygon& island, double pitch, Angle angle) {
  const Grid grid = grid_around(bounds(island), pitch);
  std::vector<Vec2> values(grid.size());
  for (std::size_t column = 0; column < grid.columns; ++column) {
    for (std::size_t row = 0; row < grid.rows; ++row)
      values[grid.index(column, row)] = doubled(static_cast<double>(angle(grid.center(column, row))));
  }
  return {grid, std::move(values), std::vector<double>(grid.size(), 1.0)};
}

}  // namespace unicursal::core::test
