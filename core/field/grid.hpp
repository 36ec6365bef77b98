// The grid of a direction field, and the walk of an edge through its squares (paper Appendix A, Figure 29).
// mm; quantities "in squares" are multiples of the pitch, measured from the origin.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "core/geometry/polygon.hpp"

namespace unicursal::core {

/// Squares are numbered column by column, upwards, like the sums (38).
struct Grid {
  Vec2 origin{0, 0};  ///< lower left corner of square (0, 0)
  double pitch = 1;   ///< side of a square, mm
  std::size_t columns = 0, rows = 0;

  std::size_t size() const { return columns * rows; }
  std::size_t index(std::size_t column, std::size_t row) const { return column * rows + row; }
  Vec2 center(std::size_t column, std::size_t row) const {
    return origin + pitch * Vec2(static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5);
  }
  Vec2 in_squares(const Vec2& point) const { return (point - origin) / pitch; }
};

/// A grid around a box, centred on it, with about one square to spare on every side. Boxes that would need
/// more than 2^21 squares get a coarser pitch, so that memory stays within about 250 MB.
Grid grid_around(const Box& box, double pitch);

/// The piece of an edge within one square. Outside the grid, pieces are not divided further, and `column` or
/// `row` is one step outside.
struct EdgePiece {
  std::ptrdiff_t column, row;  ///< −1 … columns, −1 … rows
  double share;                ///< length ÷ length of the edge; the sum over all pieces is 1
  double height;               ///< y of the piece's midpoint, in squares
};

/// The grid lines that one coordinate of an edge crosses, in the order of the crossings.
class LineCrossings {
 public:
  LineCrossings(double from, double to, std::size_t lines)
      : from_(from), per_line_(1 / (to - from)), step_(to > from ? 1 : -1) {
    const auto most = static_cast<double>(lines);
    if (to > from) {
      line_ = std::max(std::floor(from) + 1, 0.0);
      left_ = std::min(std::ceil(to) - 1, most) - line_ + 1;
    } else if (to < from) {
      line_ = std::min(std::ceil(from) - 1, most);
      left_ = line_ - std::max(std::floor(to) + 1, 0.0) + 1;
    }
  }

  /// Where on the edge (0 at its start, 1 at its end) it crosses the next line; infinity after the last.
  double next() const {
    return left_ > 0 ? (line_ - from_) * per_line_ : std::numeric_limits<double>::infinity();
  }
  void pass() {
    line_ += step_;
    --left_;
  }

 private:
  double from_, per_line_, step_, line_ = 0;
  double left_ = 0;  ///< lines still to be crossed
};

/// Calls visit(EdgePiece) along the edge a → b, given in squares. Precondition: finite.
template <typename Visit>
void each_piece(const Grid& grid, const Vec2& a, const Vec2& b, Visit visit) {
  const auto number = [](double position, std::size_t count) {
    return static_cast<std::ptrdiff_t>(std::clamp(std::floor(position), -1.0, static_cast<double>(count)));
  };
  LineCrossings upright(a.x(), b.x(), grid.columns), level(a.y(), b.y(), grid.rows);
  for (double at = 0; at < 1;) {
    const double x_next = upright.next(), y_next = level.next();
    const double end = std::min(std::min(x_next, y_next), 1.0);
    const Vec2 middle = a + (at + end) / 2 * (b - a);
    visit(EdgePiece{number(middle.x(), grid.columns), number(middle.y(), grid.rows), end - at, middle.y()});
    if (x_next <= end) upright.pass();
    if (y_next <= end) level.pass();
    at = end;
  }
}

}  // namespace unicursal::core
