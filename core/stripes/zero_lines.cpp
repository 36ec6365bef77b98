#include "core/stripes/zero_lines.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "core/stopping.hpp"

namespace unicursal::core {
namespace {

constexpr double squares_per_width = 6;
constexpr double room_reach = 1.2;  ///< bead widths within which the local width of the region is felt
constexpr double thin =
    0.95;  ///< bead widths from border to middle; in thinner places a loop goes there and back
constexpr double border_slope = 4;     ///< of the raised values, per bead width
constexpr double nearest_node = 0.02;  ///< of a crossing to a node, squares: loops never touch
constexpr double shortest_loop = 3;    ///< bead widths; a shorter loop would be a speck
constexpr std::size_t fewest_vertices = 5;

/// Values at the nodes of a square grid. Loops run between nodes of different sign.
struct Values {
  Vec2 origin{0, 0};
  double pitch = 0;
  std::size_t columns = 0, rows = 0;
  std::vector<double> at;

  std::size_t index(std::size_t column, std::size_t row) const { return row * columns + column; }
  Vec2 position(std::size_t column, std::size_t row) const {
    return origin + pitch * Vec2(static_cast<double>(column), static_cast<double>(row));
  }
};

/// The greatest value within `reach` columns and rows.
std::vector<double> greatest_around(const Values& grid, const std::vector<double>& values,
                                    std::size_t reach) {
  std::vector<double> along(values.size()), result(values.size());
  for (std::size_t row = 0; row < grid.rows; ++row) {
    for (std::size_t column = 0; column < grid.columns; ++column) {
      const std::size_t last = std::min(column + reach, grid.columns - 1);
      double most = 0;
      for (std::size_t k = column - std::min(column, reach); k <= last; ++k)
        most = std::max(most, values[grid.index(k, row)]);
      along[grid.index(column, row)] = most;
    }
  }
  for (std::size_t row = 0; row < grid.rows; ++row) {
    const std::size_t last = std::min(row + reach, grid.rows - 1);
    for (std::size_t column = 0; column < grid.columns; ++column) {
      double most = 0;
      for (std::size_t k = row - std::min(row, reach); k <= last; ++k)
        most = std::max(most, along[grid.index(column, k)]);
      result[grid.index(column, row)] = most;
    }
  }
  return result;
}

Values values_of(const Phase& phase, const Polygon& region, const BorderIndex& border, double w) {
  const Box box = bounds(region);
  Values grid;
  grid.pitch = w / squares_per_width;
  grid.origin = box.min - 1.3 * grid.pitch * Vec2(1, 1);
  grid.columns = static_cast<std::size_t>(std::ceil(box.size().x() / grid.pitch)) + 4;
  grid.rows = static_cast<std::size_t>(std::ceil(box.size().y() / grid.pitch)) + 4;
  grid.at.assign(grid.columns * grid.rows, 1.0);
  std::vector<double> depth(grid.at.size(), 0.0);
  for (std::size_t row = 0; row < grid.rows; ++row) {
    stop_point();
    for (std::size_t column = 0; column < grid.columns; ++column) {
      const Vec2 p = grid.position(column, row);
      if (border.contains(p)) depth[grid.index(column, row)] = border.distance(p, p, w);
    }
  }
  const auto reach = static_cast<std::size_t>(std::lround(room_reach * squares_per_width));
  const std::vector<double> room = greatest_around(grid, depth, reach);
  for (std::size_t row = 0; row < grid.rows; ++row) {
    stop_point();
    for (std::size_t column = 0; column < grid.columns; ++column) {
      const std::size_t k = grid.index(column, row);
      if (!(depth[k] > 0)) continue;
      const double edge = std::min(w, room[k]) / 2;
      const double raised = border_slope * (edge - depth[k]) / w;
      const bool free = room[k] >= thin * w && raised < 1;
      grid.at[k] = free ? std::max(phase.cosine(grid.position(column, row)), raised) : raised;
    }
  }
  return grid;
}

/// Marching squares. Lines cross each side of a square at most once.
class Tracer {
 public:
  explicit Tracer(const Values& grid) : grid_(grid), known_(2 * grid.at.size(), none) {
    for (std::size_t row = 0; row + 1 < grid.rows; ++row) {
      for (std::size_t column = 0; column + 1 < grid.columns; ++column) cut(column, row);
    }
  }

  std::vector<Curve> loops() const {
    std::vector<Curve> result;
    std::vector<char> seen(points_.size(), 0);
    for (std::size_t start = 0; start < points_.size(); ++start) {
      Curve loop;
      for (std::size_t here = start; !seen[here]; here = next_[here]) {
        seen[here] = 1;
        loop.vertices.push_back(points_[here]);
      }
      if (!loop.vertices.empty()) result.push_back(std::move(loop));
    }
    return result;
  }

 private:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  bool negative(std::size_t column, std::size_t row) const { return grid_.at[grid_.index(column, row)] < 0; }

  /// The crossing on the side that leaves a node to the right, or upwards.
  std::size_t crossing(std::size_t column, std::size_t row, bool upwards) {
    std::size_t& known = known_[2 * grid_.index(column, row) + (upwards ? 1 : 0)];
    if (known != none) return known;
    const double a = grid_.at[grid_.index(column, row)];
    const double b =
        upwards ? grid_.at[grid_.index(column, row + 1)] : grid_.at[grid_.index(column + 1, row)];
    const double share = std::clamp(a / (a - b), nearest_node, 1 - nearest_node);
    known = points_.size();
    points_.push_back(grid_.position(column, row) +
                      grid_.pitch * share * (upwards ? Vec2(0, 1) : Vec2(1, 0)));
    next_.push_back(none);
    return known;
  }

  /// Joins the crossings of one square. Sides are numbered counter-clockwise from the lower one.
  void cut(std::size_t column, std::size_t row) {
    const std::array<bool, 4> below{negative(column, row), negative(column + 1, row),
                                    negative(column + 1, row + 1), negative(column, row + 1)};
    // A line enters through a side whose far corner, counter-clockwise, is positive: so negative values stay
    // on its left.
    std::array<std::size_t, 2> entries{}, exits{};
    std::size_t entered = 0, left = 0;
    for (std::size_t side = 0; side < 4; ++side) {
      if (below[side] == below[(side + 1) % 4]) continue;
      if (below[side]) {
        entries[entered++] = side;
      } else {
        exits[left++] = side;
      }
    }
    const auto at = [&](std::size_t side) {
      return crossing(column + (side == 1 ? 1 : 0), row + (side == 2 ? 1 : 0), side % 2 != 0);
    };
    if (entered == 2) {
      // The middle decides which corners are connected.
      const double middle = grid_.at[grid_.index(column, row)] + grid_.at[grid_.index(column + 1, row)] +
                            grid_.at[grid_.index(column, row + 1)] +
                            grid_.at[grid_.index(column + 1, row + 1)];
      for (const std::size_t entry : entries)
        next_[at(entry)] = at(middle < 0 ? (entry + 1) % 4 : (entry + 3) % 4);
    } else if (entered == 1) {
      next_[at(entries[0])] = at(exits[0]);
    }
  }

  const Values& grid_;
  std::vector<std::size_t> known_;  ///< [2 · node + upwards]: index of the crossing
  std::vector<Vec2> points_;
  std::vector<std::size_t> next_;
};

}  // namespace

std::vector<Curve> zero_lines(const Phase& phase, const Polygon& region, const BorderIndex& border,
                              double bead_width) {
  const Values grid = values_of(phase, region, border, bead_width);
  std::vector<Curve> loops = Tracer(grid).loops();
  std::erase_if(loops, [&](const Curve& loop) {
    return loop.size() < fewest_vertices || loop.length() < shortest_loop * bead_width;
  });
  return loops;
}

}  // namespace unicursal::core
