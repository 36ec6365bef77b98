#include "core/geometry/lattice.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "core/geometry/clip.hpp"

namespace unicursal::core {
namespace {

struct Moments {
  double area = 0;
  Vec2 first{0, 0};  ///< area times centroid
};

Moments moments(const std::vector<Ring>& rings, const Vec2& about) {
  Moments m;
  for (const Ring& ring : rings) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vec2 a = ring[i] - about, b = ring[(i + 1) % ring.size()] - about;
      const double twice = cross(a, b);
      m.area += twice / 2;
      m.first += twice / 6 * (a + b);
    }
  }
  return m;
}

constexpr std::size_t group_columns = 4, group_rows = 4;  ///< blocks in a group
constexpr std::size_t tile_columns = 4, tile_rows = 8;    ///< groups in a tile: 64 × 64 squares

/// A block that has been found but not yet placed in the lattice.
struct FoundBlock {
  std::size_t column = 0, row = 0;  ///< counted in blocks
  std::int32_t border = -1;
};

/// Finds the blocks by halving the box, so that the squares of rectangles wholly inside need not be examined.
class Sampler {
 public:
  Sampler(const Polygon& polygon, double pitch) : pitch_(pitch) {
    const Box box = bounds(polygon);
    origin_ = box.min;
    const Vec2 squares = ((box.size() / pitch).array() + 1).floor();
    if (!(squares.x() * squares.y() < 2147483648.0)) throw std::length_error("sampling lattice too fine");
    rings_ = {polygon.outer};
    rings_.insert(rings_.end(), polygon.holes.begin(), polygon.holes.end());
    columns_ = (static_cast<std::size_t>(squares.x()) + Lattice::block_columns - 1) / Lattice::block_columns;
    rows_ = (static_cast<std::size_t>(squares.y()) + Lattice::block_rows - 1) / Lattice::block_rows;
  }

  Lattice run() {
    fill(rings_, 0, columns_, 0, rows_);
    std::sort(found_.begin(), found_.end(),
              [this](const FoundBlock& l, const FoundBlock& r) { return order(l) < order(r); });
    Lattice lattice;
    lattice.pitch = pitch_;
    lattice.borders = std::move(borders_);
    lattice.blocks.reserve(found_.size());
    for (std::size_t k = 0; k < found_.size(); ++k) {
      if (k == 0 || tile(found_[k]) != tile(found_[k - 1])) {
        lattice.tiles.push_back({corner(found_[k]), lattice.group_start.size(), 0});
      }
      if (k == 0 || group(found_[k]) != group(found_[k - 1])) lattice.group_start.push_back(k);
      lattice.tiles.back().last_group = lattice.group_start.size();
      place(found_[k], lattice);
    }
    lattice.group_start.push_back(found_.size());
    return lattice;
  }

 private:
  using Place = std::pair<std::size_t, std::size_t>;  ///< row, column

  static Place group(const FoundBlock& b) { return {b.row / group_rows, b.column / group_columns}; }
  static Place tile(const FoundBlock& b) {
    return {b.row / (group_rows * tile_rows), b.column / (group_columns * tile_columns)};
  }
  static std::tuple<Place, Place, std::size_t, std::size_t> order(const FoundBlock& b) {
    return {tile(b), group(b), b.row, b.column};
  }

  Vec2 at(std::size_t column, std::size_t row) const {
    return origin_ + pitch_ * Vec2(static_cast<double>(column), static_cast<double>(row));
  }
  /// Lower left corner of the tile that contains a block.
  Vec2 corner(const FoundBlock& b) const {
    const Place t = tile(b);
    return at(t.second * group_columns * tile_columns * Lattice::block_columns,
              t.first * group_rows * tile_rows * Lattice::block_rows);
  }

  void place(const FoundBlock& found, Lattice& lattice) const {
    const Vec2 low = at(found.column * Lattice::block_columns, found.row * Lattice::block_rows) -
                     lattice.tiles.back().corner;
    lattice.blocks.push_back({static_cast<float>(low.x()), static_cast<float>(low.y()),
                              static_cast<std::int32_t>(lattice.tiles.size()) - 1, found.border});
    if (found.border < 0) return;
    Lattice::BorderBlock& border = lattice.borders[static_cast<std::size_t>(found.border)];
    for (float& x : border.x) x += static_cast<float>(low.x());
    for (float& y : border.y) y += static_cast<float>(low.y());
  }

  /// Fills the blocks [c0, c1) × [r0, r1) from rings that are already clipped to them.
  void fill(const std::vector<Ring>& rings, std::size_t c0, std::size_t c1, std::size_t r0, std::size_t r1) {
    if (rings.empty() || c0 == c1 || r0 == r1) return;
    const Vec2 low = at(c0 * Lattice::block_columns, r0 * Lattice::block_rows);
    const Vec2 high = at(c1 * Lattice::block_columns, r1 * Lattice::block_rows);
    if (moments(rings, low).area > (high - low).prod() * (1 - 1e-12)) {
      for (std::size_t r = r0; r < r1; ++r) {
        for (std::size_t c = c0; c < c1; ++c) found_.push_back({c, r, -1});
      }
    } else if (c1 - c0 == 1 && r1 - r0 == 1) {
      add_border_block(rings, c0, r0);
    } else if (2 * (c1 - c0) >= r1 - r0 && c1 - c0 > 1) {
      const std::size_t middle = (c0 + c1) / 2;
      const double x = at(middle * Lattice::block_columns, 0).x();
      fill(clipped(rings, Side::left, x), c0, middle, r0, r1);
      fill(clipped(rings, Side::right, x), middle, c1, r0, r1);
    } else {
      const std::size_t middle = (r0 + r1) / 2;
      const double y = at(0, middle * Lattice::block_rows).y();
      fill(clipped(rings, Side::below, y), c0, c1, r0, middle);
      fill(clipped(rings, Side::above, y), c0, c1, middle, r1);
    }
  }

  void add_border_block(const std::vector<Ring>& rings, std::size_t column, std::size_t row) {
    Lattice::BorderBlock block;
    const Vec2 low = at(column * Lattice::block_columns, row * Lattice::block_rows);
    bool any = false;
    for (std::size_t r = 0; r < Lattice::block_rows; ++r) {
      const double y = low.y() + static_cast<double>(r) * pitch_;
      const std::vector<Ring> strip = clipped(clipped(rings, Side::above, y), Side::below, y + pitch_);
      for (std::size_t c = 0; c < Lattice::block_columns; ++c) {
        const double x = low.x() + static_cast<double>(c) * pitch_;
        const Moments m =
            moments(clipped(clipped(strip, Side::right, x), Side::left, x + pitch_), Vec2(x, y));
        const std::size_t lane = r * Lattice::block_columns + c;
        const bool inside = m.area > 1e-9 * pitch_ * pitch_;
        const Vec2 middle(pitch_ / 2, pitch_ / 2);
        const Vec2 sample = Vec2(x, y) - low + (inside ? Vec2(m.first / m.area) : middle);
        block.x[lane] = static_cast<float>(sample.x());
        block.y[lane] = static_cast<float>(sample.y());
        block.weight[lane] = inside ? static_cast<float>(m.area) : 0.0F;
        any = any || inside;
      }
    }
    if (!any) return;
    found_.push_back({column, row, static_cast<std::int32_t>(borders_.size())});
    borders_.push_back(block);
  }

  double pitch_;
  Vec2 origin_{0, 0};
  std::size_t columns_ = 0, rows_ = 0;  ///< of blocks
  std::vector<Ring> rings_;
  std::vector<FoundBlock> found_;
  std::vector<Lattice::BorderBlock> borders_;
};

}  // namespace

Vec2 Lattice::position(std::size_t sample) const {
  const Block& block = blocks[sample / lanes];
  const std::size_t lane = sample % lanes;
  const Vec2& corner = tiles[static_cast<std::size_t>(block.tile)].corner;
  if (block.border >= 0) {
    const BorderBlock& border = borders[static_cast<std::size_t>(block.border)];
    return corner + Vec2(border.x[lane], border.y[lane]);
  }
  const Vec2 square(static_cast<double>(lane % block_columns), static_cast<double>(lane / block_columns));
  return corner + Vec2(block.x, block.y) + pitch * (square + Vec2(0.5, 0.5));
}

double Lattice::total_weight() const {
  double sum = 0;
  for (std::size_t k = 0; k < size(); ++k) sum += weight(k);
  return sum;
}

Lattice sample(const Polygon& polygon, double pitch) {
  return Sampler(polygon, pitch).run();
}

}  // namespace unicursal::core
