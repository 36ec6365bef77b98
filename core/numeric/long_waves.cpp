#include "core/numeric/long_waves.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace unicursal::core {
namespace {

constexpr std::size_t range = 4096;  ///< points that one worker takes at a time

/// Calls visit(coarse node, share) for the nodes of a grid of meshes twice as wide that a node lies between.
template <typename Visit>
void for_parents(std::size_t column, std::size_t row, std::size_t columns, Visit visit) {
  const std::size_t c = column / 2, r = row / 2;
  const bool between_columns = column % 2 != 0, between_rows = row % 2 != 0;
  const double share = (between_columns ? 0.5 : 1) * (between_rows ? 0.5 : 1);
  visit(r * columns + c, share);
  if (between_columns) visit(r * columns + c + 1, share);
  if (between_rows) visit((r + 1) * columns + c, share);
  if (between_columns && between_rows) visit((r + 1) * columns + c + 1, share);
}

}  // namespace

LongWaves::LongWaves(const std::vector<Vec2>& points, double finest, double strength) : strength_(strength) {
  if (points.empty()) return;
  Vec2 low = points.front(), high = low;
  for (const Vec2& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const Vec2 meshes = (high - low) / finest;
  Grid grid{static_cast<std::size_t>(meshes.x()) + 2, static_cast<std::size_t>(meshes.y()) + 2};
  places_.reserve(points.size());
  for (const Vec2& point : points) {
    const Vec2 at = (point - low) / finest;
    const auto column = static_cast<std::size_t>(at.x()), row = static_cast<std::size_t>(at.y());
    places_.push_back({static_cast<std::uint32_t>(row * grid.columns + column),
                       static_cast<float>(at.x() - std::floor(at.x())),
                       static_cast<float>(at.y() - std::floor(at.y()))});
  }
  grids_.push_back(grid);
  while (std::max(grid.columns, grid.rows) > 3) {
    grid = {grid.columns / 2 + 1, grid.rows / 2 + 1};
    grids_.push_back(grid);
  }
}

/// Pᵀ of the finest grid.
LongWaves::Field LongWaves::gathered(const Field& field) const {
  const std::size_t columns = grids_.front().columns;
  Field nodes(columns * grids_.front().rows, Vec2(0, 0));
  for (std::size_t i = 0; i < field.size(); ++i) {
    const auto& [node, x, y] = places_[i];
    const double fx = x, fy = y;
    nodes[node] += (1 - fx) * (1 - fy) * field[i];
    nodes[node + 1] += fx * (1 - fy) * field[i];
    nodes[node + columns] += (1 - fx) * fy * field[i];
    nodes[node + columns + 1] += fx * fy * field[i];
  }
  return nodes;
}

LongWaves::Field LongWaves::coarser(const Field& nodes, const Grid& from, const Grid& to) {
  Field result(to.columns * to.rows, Vec2(0, 0));
  for (std::size_t r = 0; r < from.rows; ++r) {
    for (std::size_t c = 0; c < from.columns; ++c) {
      for_parents(c, r, to.columns, [&](std::size_t parent, double share) {
        result[parent] += share * nodes[r * from.columns + c];
      });
    }
  }
  return result;
}

void LongWaves::add_finer(Field& nodes, const Grid& at, const Field& coarse, const Grid& of) {
  for (std::size_t r = 0; r < at.rows; ++r) {
    for (std::size_t c = 0; c < at.columns; ++c) {
      for_parents(c, r, of.columns, [&](std::size_t parent, double share) {
        nodes[r * at.columns + c] += share * coarse[parent];
      });
    }
  }
}

void LongWaves::apply(std::vector<Vec2>& field, Workers* workers) const {
  if (empty()) return;
  assert(field.size() == places_.size());
  // Bilinear functions of a coarse grid are such of the finer ones, so all sums pass through the finest.
  std::vector<Field> levels{gathered(field)};
  for (std::size_t k = 1; k < grids_.size(); ++k)
    levels.push_back(coarser(levels.back(), grids_[k - 1], grids_[k]));
  for (std::size_t k = grids_.size(); k-- > 1;) add_finer(levels[k - 1], grids_[k - 1], levels[k], grids_[k]);
  const Field& nodes = levels.front();
  const std::size_t columns = grids_.front().columns;
  const auto spread = [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const auto& [node, x, y] = places_[i];
      const double fx = x, fy = y;
      field[i] += strength_ * ((1 - fy) * ((1 - fx) * nodes[node] + fx * nodes[node + 1]) +
                               fy * ((1 - fx) * nodes[node + columns] + fx * nodes[node + columns + 1]));
    }
  };
  if (workers != nullptr) {
    workers->ranges(field.size(), range, spread);
  } else {
    spread(0, field.size());
  }
}

}  // namespace unicursal::core
