#include "core/field/border_extension.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <utility>

#include "core/field/direction_field.hpp"
#include "core/field/grid_cover.hpp"
#include "core/numeric/grid_distance.hpp"
#include "core/stopping.hpp"

namespace unicursal::core {
namespace {

constexpr double least_distance = 0.5;  ///< squares; the border crosses a fixed square beside its centre
constexpr double vanishing = 1e-9;      ///< ‖V‖ below which rounding decides the direction
constexpr int cycles = 4;  ///< V-cycles per level; a test compares the result with plain relaxation
constexpr int sweeps = 2;  ///< relaxations before and after each visit of the coarser level
constexpr int coarsest_sweeps = 16;

enum class Square : std::uint8_t { outside, fixed, free };

/// One grid of the hierarchy. Free squares never lie on the rim of the grid.
struct Level {
  std::size_t columns = 0, rows = 0;
  std::vector<Square> kind;
  std::vector<double> stiffness;  ///< 1/d² of the square; between two neighbours the mean counts
  std::vector<Vec2> value;        ///< the solution, or the correction to the finer level's
  /// Right-hand side: Σ over neighbours of 2 · stiffness · (neighbour − own) = source.
  std::vector<Vec2> source;

  Level(std::size_t columns_, std::size_t rows_)
      : columns(columns_),
        rows(rows_),
        kind(columns_ * rows_, Square::outside),
        stiffness(columns_ * rows_, 0),
        value(columns_ * rows_, Vec2(0, 0)),
        source(columns_ * rows_, Vec2(0, 0)) {}

  struct Pull {
    Vec2 sum{0, 0};    ///< Σ stiffness · value of the neighbours
    double total = 0;  ///< Σ stiffness
  };
  Pull pull(std::size_t k) const {
    const double own = stiffness[k];
    const double below = own + stiffness[k - 1], above = own + stiffness[k + 1];
    const double left = own + stiffness[k - rows], right = own + stiffness[k + rows];
    return {below * value[k - 1] + above * value[k + 1] + left * value[k - rows] + right * value[k + rows],
            below + above + left + right};
  }

  template <typename Visit>
  void each_free(std::size_t colour, std::size_t step, Visit visit) const {
    for (std::size_t column = 1; column + 1 < columns; ++column) {
      const std::size_t base = column * rows;
      for (std::size_t row = 1 + (column + colour) % step; row + 1 < rows; row += step) {
        if (kind[base + row] == Square::free) visit(base + row);
      }
    }
  }

  void relax(int times) {
    for (int k = 0; k < 2 * times; ++k) {
      each_free(static_cast<std::size_t>(k % 2), 2, [&](std::size_t i) {
        const Pull p = pull(i);
        value[i] = (p.sum - source[i]) / p.total;
      });
    }
  }
};

/// Sums over the border in every square that it meets: its length, in squares, and V times length.
struct BorderMeans {
  std::vector<Vec2> sum;
  std::vector<double> length;

  BorderMeans(const Grid& grid, const Region& region) : sum(grid.size(), Vec2(0, 0)), length(grid.size()) {
    for (const Polygon& polygon : region) {
      add(grid, polygon.outer);
      for (const Ring& hole : polygon.holes) add(grid, hole);
    }
  }

  void add(const Grid& grid, const Ring& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vec2 a = grid.in_squares(ring[i]), b = grid.in_squares(ring[(i + 1) % ring.size()]);
      const double edge_length = (b - a).norm();
      const Vec2 v = doubled(Vec2(b - a));
      each_piece(grid, a, b, [&](const EdgePiece& piece) {
        assert(piece.column >= 0 && piece.row >= 0);
        const auto square = grid.index(std::size_t(piece.column), std::size_t(piece.row));
        sum[square] += piece.share * edge_length * v;
        length[square] += piece.share * edge_length;
      });
    }
  }
};

/// The weight 1/d² (see the header).
void set_stiffness(Level& level, const Grid& grid) {
  std::vector<std::uint8_t> fixed(grid.size());
  for (std::size_t k = 0; k < grid.size(); ++k) fixed[k] = level.kind[k] == Square::fixed;
  const std::vector<double> distance = distance_to_marked(grid.columns, grid.rows, fixed);
  for (std::size_t k = 0; k < grid.size(); ++k) {
    level.stiffness[k] = std::pow(std::max(distance[k], least_distance), -2);
  }
}

Level finest_level(const Grid& grid, const Region& region) {
  const BorderMeans border(grid, region);
  const std::vector<double> inside = cover(grid, region);
  Level level(grid.columns, grid.rows);
  for (std::size_t k = 0; k < grid.size(); ++k) {
    if (border.length[k] > 0) {
      level.kind[k] = Square::fixed;
      level.value[k] = border.sum[k] / border.length[k];
    } else if (inside[k] > 0.5) {
      level.kind[k] = Square::free;
    }
  }
  set_stiffness(level, grid);
  return level;
}

/// The next level, with squares twice as wide. A square is fixed if one of its four is, at the mean of the
/// fixed ones.
Level coarser(const Level& fine) {
  Level coarse((fine.columns + 1) / 2, (fine.rows + 1) / 2);
  std::vector<int> fixed(coarse.kind.size(), 0);
  for (std::size_t column = 0; column < fine.columns; ++column) {
    for (std::size_t row = 0; row < fine.rows; ++row) {
      const std::size_t from = column * fine.rows + row, to = column / 2 * coarse.rows + row / 2;
      coarse.kind[to] = coarse.kind[to] == Square::fixed || fine.kind[from] == Square::outside
                            ? coarse.kind[to]
                            : fine.kind[from];
      coarse.stiffness[to] += fine.stiffness[from] / 4;
      if (fine.kind[from] != Square::fixed) continue;
      coarse.value[to] += fine.value[from];
      ++fixed[to];
    }
  }
  for (std::size_t k = 0; k < fixed.size(); ++k) {
    if (fixed[k] > 0) coarse.value[k] /= fixed[k];
  }
  return coarse;
}

class Multigrid {
 public:
  explicit Multigrid(Level finest) {
    levels_.push_back(std::move(finest));
    while (std::min(levels_.back().columns, levels_.back().rows) > 3) {
      Level next = coarser(levels_.back());
      if (std::find(next.kind.begin(), next.kind.end(), Square::free) == next.kind.end()) break;
      levels_.push_back(std::move(next));
    }
  }

  std::vector<Vec2> solve() {
    levels_.back().relax(coarsest_sweeps);
    for (std::size_t k = levels_.size() - 1; k-- > 0;) {
      prolong(k, [](Vec2& value, const Vec2& coarse) { value = coarse; });
      for (int cycle = 0; cycle < cycles; ++cycle) improve(k);
    }
    return std::move(levels_.front().value);
  }

 private:
  /// A V-cycle from level k down. Overwrites the coarser levels.
  void improve(std::size_t k) {
    stop_point();
    if (k + 1 == levels_.size()) return levels_[k].relax(coarsest_sweeps);
    levels_[k].relax(sweeps);
    restrict_residual(k);
    improve(k + 1);
    prolong(k, [](Vec2& value, const Vec2& coarse) { value += coarse; });
    levels_[k].relax(sweeps);
  }

  /// Sets up the coarser level to compute the correction.
  void restrict_residual(std::size_t k) {
    const Level& fine = levels_[k];
    Level& coarse = levels_[k + 1];
    std::fill(coarse.value.begin(), coarse.value.end(), Vec2(0, 0));
    std::fill(coarse.source.begin(), coarse.source.end(), Vec2(0, 0));
    fine.each_free(0, 1, [&](std::size_t i) {
      const Level::Pull p = fine.pull(i);
      // The sum over four squares is their mean, times 4 for a difference quotient over twice the pitch.
      coarse.source[i / fine.rows / 2 * coarse.rows + i % fine.rows / 2] +=
          fine.source[i] - (p.sum - p.total * fine.value[i]);
    });
  }

  /// Bilinear interpolation: along each axis, three parts of the coarse square that contains it, one of the
  /// next.
  template <typename Take>
  void prolong(std::size_t k, Take take) {
    Level& fine = levels_[k];
    const Level& coarse = levels_[k + 1];
    fine.each_free(0, 1, [&](std::size_t i) {
      const std::size_t column = i / fine.rows, row = i % fine.rows;
      const std::size_t own = column / 2 * coarse.rows + row / 2;
      const std::size_t beside = column % 2 == 1 ? own + coarse.rows : own - coarse.rows;
      const std::size_t shift = row % 2 == 1 ? 1 : std::size_t(0) - 1;
      const Vec2 near = 3 * coarse.value[own] + coarse.value[beside];
      const Vec2 far = 3 * coarse.value[own + shift] + coarse.value[beside + shift];
      take(fine.value[i], Vec2((3 * near + far) / 16));
    });
  }

  std::vector<Level> levels_;
};

}  // namespace

std::vector<Vec2> extended_tangents(const Grid& grid, const Region& region) {
  std::vector<Vec2> result = Multigrid(finest_level(grid, region)).solve();
  for (Vec2& v : result) {
    const double norm = v.norm();
    v = norm > vanishing ? Vec2(v / norm) : Vec2(0, 0);
  }
  return result;
}

}  // namespace unicursal::core
