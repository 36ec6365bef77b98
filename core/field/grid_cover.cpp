#include "core/field/grid_cover.hpp"

namespace unicursal::core {
namespace {

/// Signed areas, in squares, that are summed up on a walk along all edges.
struct Ledger {
  const Grid& grid;
  std::vector<double> own;    ///< per square: the area in it under edges that pass through it
  std::vector<double> below;  ///< per square: the area that these edges add to each square below it

  void add(const Vec2& a, const Vec2& b) {
    const Vec2 from = grid.in_squares(a), to = grid.in_squares(b);
    const double width = from.x() - to.x();  // leftward edges have the inside below them
    each_piece(grid, from, to, [&](const EdgePiece& piece) {
      const auto columns = static_cast<std::ptrdiff_t>(grid.columns);
      if (piece.column < 0 || piece.column >= columns || piece.row < 0) return;
      const auto rows = static_cast<std::ptrdiff_t>(grid.rows);
      const std::ptrdiff_t row = std::min(piece.row, rows - 1);
      const std::size_t square = grid.index(std::size_t(piece.column), std::size_t(row));
      const double full = width * piece.share;
      own[square] += full * std::min(piece.height - static_cast<double>(row), 1.0);
      below[square] += full;
    });
  }

  void add(const Ring& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) add(ring[i], ring[(i + 1) % ring.size()]);
  }
};

}  // namespace

std::vector<double> cover(const Grid& grid, const Region& region) {
  Ledger ledger{grid, std::vector<double>(grid.size()), std::vector<double>(grid.size())};
  for (const Polygon& polygon : region) {
    ledger.add(polygon.outer);
    for (const Ring& hole : polygon.holes) ledger.add(hole);
  }
  std::vector<double> result = std::move(ledger.own);
  for (std::size_t column = 0; column < grid.columns; ++column) {
    double above = 0;
    for (std::size_t row = grid.rows; row-- > 0;) {
      const std::size_t square = grid.index(column, row);
      result[square] = std::clamp(result[square] + above, 0.0, 1.0);
      above += ledger.below[square];
    }
  }
  return result;
}

}  // namespace unicursal::core
