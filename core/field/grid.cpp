#include "core/field/grid.hpp"

#include <cassert>

namespace unicursal::core {

Grid grid_around(const Box& box, double pitch) {
  assert(pitch > 0);
  constexpr double most_squares = 1 << 21, most_in_a_row = 1 << 20;
  const double width = box.size().x(), height = box.size().y();
  Grid grid;
  grid.pitch = std::max(
      {pitch, std::sqrt(width * height / most_squares), width / most_in_a_row, height / most_in_a_row});
  grid.columns = static_cast<std::size_t>(std::ceil(width / grid.pitch)) + 2;
  grid.rows = static_cast<std::size_t>(std::ceil(height / grid.pitch)) + 2;
  const Vec2 size(static_cast<double>(grid.columns), static_cast<double>(grid.rows));
  grid.origin = box.center() - grid.pitch / 2 * size;
  return grid;
}

}  // namespace unicursal::core
