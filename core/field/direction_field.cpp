#include "core/field/direction_field.hpp"

#include <cassert>
#include <utility>

namespace unicursal::core {

DirectionField::DirectionField(const Grid& grid, std::vector<Vec2> values,
                               const std::vector<double>& island_share)
    : grid_(grid), values_(std::move(values)), sums_(values_) {
  assert(values_.size() == grid.size() && island_share.size() == grid.size());
  const double square = grid.pitch * grid.pitch;
  for (std::size_t k = 0; k < values_.size(); ++k) {
    aligned_area_ += square * island_share[k] * values_[k].norm();
    if (k % grid.rows != 0) sums_[k] += sums_[k - 1];
  }
}

Vec2 DirectionField::at(const Vec2& point) const {
  const Vec2 p = grid_.in_squares(point);
  const auto columns = static_cast<double>(grid_.columns), rows = static_cast<double>(grid_.rows);
  if (!(p.x() >= 0 && p.x() < columns && p.y() >= 0 && p.y() < rows)) return {0, 0};
  return values_[grid_.index(static_cast<std::size_t>(p.x()), static_cast<std::size_t>(p.y()))];
}

Vec2 DirectionField::integral_under(const Vec2& a, const Vec2& b) const {
  const Vec2 from = grid_.in_squares(a), to = grid_.in_squares(b);
  const auto columns = static_cast<std::ptrdiff_t>(grid_.columns),
             rows = static_cast<std::ptrdiff_t>(grid_.rows);
  Vec2 mean(0, 0);  // mean over the edge's width of the inner integral of (37), in squares
  each_piece(grid_, from, to, [&](const EdgePiece& piece) {
    if (piece.column < 0 || piece.column >= columns || piece.row < 0) return;
    const std::ptrdiff_t row = std::min(piece.row, rows - 1);
    const auto square = static_cast<std::size_t>(piece.column * rows + row);
    const double above = std::max(static_cast<double>(row + 1) - piece.height, 0.0);
    mean += piece.share * (sums_[square] - above * values_[square]);  // (41)
  });
  // One factor is the height of a square, which (41) lacks; the other turns the width from squares into mm.
  return grid_.pitch * grid_.pitch * (to.x() - from.x()) * mean;
}

Vec2 DirectionField::integral(const Ring& ring) const {
  Vec2 result(0, 0);
  if (empty()) return result;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    result -= integral_under(ring[i], ring[i + 1 == ring.size() ? 0 : i + 1]);
  }
  return result;
}

Vec2 DirectionField::integral(const Polygon& polygon) const {
  Vec2 result = integral(polygon.outer);
  for (const Ring& hole : polygon.holes) result += integral(hole);
  return result;
}

Vec2 DirectionField::integral_around(const Vec2& a, const Vec2& b, double width) const {
  const double length = (b - a).norm();
  if (empty() || !(length > 0)) return {0, 0};
  const Vec2 side = width / 2 / length * perpendicular(b - a);
  const Vec2 right_a = a - side, right_b = b - side, left_b = b + side, left_a = a + side;
  return -integral_under(right_a, right_b) - integral_under(right_b, left_b) -
         integral_under(left_b, left_a) - integral_under(left_a, right_a);
}

Vec2 DirectionField::quick_integral_around(const Vec2& a, const Vec2& b, double width) const {
  const double length = (b - a).norm();
  if (empty() || !(length > 0)) return {0, 0};
  constexpr double gauss = 0.57735026918962576;  // 1/√3, of the half side
  const Vec2 middle = (a + b) / 2, along = gauss / 2 * (b - a);
  const Vec2 side = gauss * width / 2 / length * perpendicular(b - a);
  const Vec2 sum = at(middle + along + side) + at(middle + along - side) + at(middle - along + side) +
                   at(middle - along - side);
  return length * width / 4 * sum;
}

}  // namespace unicursal::core
