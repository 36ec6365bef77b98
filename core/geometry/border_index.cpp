#include "core/geometry/border_index.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace unicursal::core {
namespace {

/// What an edge a → b adds to the winding number of a point that moves across it towards +x: 1 if the edge
/// runs downwards, −1 if it runs upwards.
int step(const Vec2& a, const Vec2& b) {
  return a.y() > b.y() ? 1 : -1;
}

/// What the edge adds on the ray from −x to `p`. Edges are half-open in y, so that a vertex counts once.
int steps_on_left_ray(const Vec2& a, const Vec2& b, const Vec2& p) {
  if ((a.y() > p.y()) == (b.y() > p.y())) return 0;
  return p.x() > (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y()) + a.x() ? step(a, b) : 0;
}

}  // namespace

double distance_between_segments(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  const Vec2 ab = b - a, cd = d - c;
  const double c_side = cross(ab, c - a), d_side = cross(ab, d - a);
  const double a_side = cross(cd, a - c), b_side = cross(cd, b - c);
  if (((c_side > 0) != (d_side > 0)) && ((a_side > 0) != (b_side > 0))) return 0;
  return std::min(std::min(distance_to_segment(a, c, d), distance_to_segment(b, c, d)),
                  std::min(distance_to_segment(c, a, b), distance_to_segment(d, a, b)));
}

BorderIndex::BorderIndex(const Polygon& polygon, double pitch) : pitch_(pitch) {
  assert(pitch > 0 && polygon.outer.size() >= 3);
  const auto add = [&](const Ring& ring, std::size_t number) {
    first_edge_.push_back(edges_.size());
    for (std::size_t i = 0; i < ring.size(); ++i) {
      edges_.push_back({ring[i], ring[(i + 1) % ring.size()], number, i});
    }
  };
  add(polygon.outer, 0);
  for (std::size_t h = 0; h < polygon.holes.size(); ++h) add(polygon.holes[h], h + 1);
  first_edge_.push_back(edges_.size());

  const Box box = bounds(polygon);
  // At most ten million squares: huge boxes get coarser ones.
  const double most = 1e7;
  pitch_ = std::max(pitch, std::sqrt(std::max(box.size().x() * box.size().y(), 1e-12) / most));
  // An irrational offset, so that no vertex lies on the corner of a square, where parity is undecided.
  origin_ = box.min - pitch_ * Vec2(0.61803398875, 0.5698402911);
  columns_ = static_cast<std::ptrdiff_t>(std::ceil(box.size().x() / pitch_)) + 3;
  rows_ = static_cast<std::ptrdiff_t>(std::ceil(box.size().y() / pitch_)) + 3;

  const auto each_square = [&](auto visit) {
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      const Vec2 &a = edges_[e].a, &b = edges_[e].b;
      // Visits the squares of the edge row by row, in its x range within each row.
      const Range r = range({a.cwiseMin(b), a.cwiseMax(b)});
      for (std::ptrdiff_t row = r.row0; row <= r.row1; ++row) {
        std::ptrdiff_t from = r.column0, to = r.column1;
        if (r.row0 != r.row1) {
          const double y0 = origin_.y() + static_cast<double>(row) * pitch_, y1 = y0 + pitch_;
          const auto x_at = [&](double y) {
            const double t = std::clamp((y - a.y()) / (b.y() - a.y()), 0.0, 1.0);
            return a.x() + t * (b.x() - a.x());
          };
          const double slack = 1e-9 * pitch_;
          from = column_of(std::min(x_at(y0), x_at(y1)) - slack);
          to = column_of(std::max(x_at(y0), x_at(y1)) + slack);
        }
        for (std::ptrdiff_t column = from; column <= to; ++column) visit(row * columns_ + column, e);
      }
    }
  };
  start_.assign(static_cast<std::size_t>(columns_ * rows_) + 1, 0);
  each_square([&](std::ptrdiff_t square, std::size_t) { ++start_[static_cast<std::size_t>(square) + 1]; });
  for (std::size_t s = 1; s < start_.size(); ++s) start_[s] += start_[s - 1];
  entries_.resize(start_.back());
  std::vector<std::size_t> fill(start_.begin(), start_.end() - 1);
  each_square(
      [&](std::ptrdiff_t square, std::size_t e) { entries_[fill[static_cast<std::size_t>(square)]++] = e; });

  winding_.assign(static_cast<std::size_t>(columns_ * rows_), 0);
  for (std::ptrdiff_t row = 0; row < rows_; ++row) {
    // The winding number at the lower left corner of each square follows from the edges that cross this line
    // to the left of it.
    const double y = origin_.y() + static_cast<double>(row) * pitch_;
    std::vector<std::pair<double, int>> crossings;
    const std::ptrdiff_t below = std::max<std::ptrdiff_t>(row - 1, 0);
    std::vector<std::size_t> seen;
    for (std::ptrdiff_t r : {below, row}) {
      const auto first = static_cast<std::size_t>(r * columns_),
                 last = first + static_cast<std::size_t>(columns_);
      seen.insert(seen.end(), entries_.begin() + static_cast<std::ptrdiff_t>(start_[first]),
                  entries_.begin() + static_cast<std::ptrdiff_t>(start_[last]));
    }
    std::sort(seen.begin(), seen.end());
    seen.erase(std::unique(seen.begin(), seen.end()), seen.end());
    for (std::size_t e : seen) {
      const Vec2 &a = edges_[e].a, &b = edges_[e].b;
      if ((a.y() > y) == (b.y() > y)) continue;
      crossings.emplace_back((b.x() - a.x()) * (y - a.y()) / (b.y() - a.y()) + a.x(), step(a, b));
    }
    std::sort(crossings.begin(), crossings.end());
    std::size_t passed = 0;
    int winding = 0;
    for (std::ptrdiff_t column = 0; column < columns_; ++column) {
      const double x = origin_.x() + static_cast<double>(column) * pitch_;
      while (passed < crossings.size() && crossings[passed].first < x) winding += crossings[passed++].second;
      winding_[static_cast<std::size_t>(row * columns_ + column)] = static_cast<std::int16_t>(winding);
    }
  }
}

std::ptrdiff_t BorderIndex::column_of(double x) const {
  return static_cast<std::ptrdiff_t>(
      std::clamp(std::floor((x - origin_.x()) / pitch_), 0.0, static_cast<double>(columns_ - 1)));
}

std::ptrdiff_t BorderIndex::row_of(double y) const {
  return static_cast<std::ptrdiff_t>(
      std::clamp(std::floor((y - origin_.y()) / pitch_), 0.0, static_cast<double>(rows_ - 1)));
}

BorderIndex::Range BorderIndex::range(const Box& box) const {
  return {row_of(box.min.y()), row_of(box.max.y()), column_of(box.min.x()), column_of(box.max.x())};
}

int BorderIndex::winding(const Vec2& point) const {
  const double right = origin_.x() + static_cast<double>(columns_) * pitch_;
  const double upper = origin_.y() + static_cast<double>(rows_) * pitch_;
  if (!(point.x() > origin_.x() && point.y() > origin_.y() && point.x() < right && point.y() < upper))
    return 0;
  // Start at the corner of the square, where the number is known. Go up to the height of the point, then
  // right.
  const std::ptrdiff_t row = row_of(point.y()), column = column_of(point.x());
  const auto square = static_cast<std::size_t>(row * columns_ + column);
  int winding = winding_[square];
  const Vec2 corner = origin_ + pitch_ * Vec2(static_cast<double>(column), static_cast<double>(row));
  for (std::size_t k = start_[square]; k < start_[square + 1]; ++k) {
    const Vec2 &a = edges_[entries_[k]].a, &b = edges_[entries_[k]].b;
    // Up along x = corner.x from corner.y to point.y …
    if ((a.x() >= corner.x()) != (b.x() >= corner.x())) {
      const double y = (b.y() - a.y()) * (corner.x() - a.x()) / (b.x() - a.x()) + a.y();
      if (y > corner.y() && y <= point.y()) winding += a.x() < b.x() ? 1 : -1;
    }
    // … then right along y = point.y.
    winding += steps_on_left_ray(a, b, point) - steps_on_left_ray(a, b, {corner.x(), point.y()});
  }
  return winding;
}

double BorderIndex::distance(const Vec2& a, const Vec2& b, double limit) const {
  double best = limit;
  const Vec2 reach(limit, limit);
  near({a.cwiseMin(b) - reach, a.cwiseMax(b) + reach}, [&](std::size_t e) {
    best = std::min(best, distance_between_segments(a, b, edges_[e].a, edges_[e].b));
  });
  return best;
}

}  // namespace unicursal::core
