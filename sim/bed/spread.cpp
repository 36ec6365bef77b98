#include "sim/bed/spread.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace unicursal::sim {

namespace {

constexpr double most_pixels = 20e6;    // pixels of the whole bed
constexpr double margin = 10;           // mm around the bed that the raster covers, too
constexpr double widest_radius = 3;     // mm; a wider bead piles up within this radius
constexpr double steps_per_width = 8;   // steps per bead width along a bead
constexpr double full = 1 - 1e-6;       // fill from which a pixel counts as full
constexpr double golden_angle = 2.399;  // radians; scatters the order of pixels at the same distance

double along(double from, double to, double part) {
  return from + part * (to - from);
}

int tiles_for(double size, double pixel, int side) {
  return static_cast<int>(std::ceil((size + 2 * margin) / pixel / side));
}

}  // namespace

void Spread::Grid::clear() {
  for (int y = bottom; y <= top; ++y) {
    for (int x = left; x <= right; ++x) {
      const auto& tile =
          tiles[static_cast<std::size_t>(y) * static_cast<std::size_t>(across) + static_cast<std::size_t>(x)];
      if (tile) std::fill(tile->pixels.begin(), tile->pixels.end(), RasterPixel{});
    }
  }
  left = across, bottom = down, right = top = -1;
}

RasterPixel* Spread::Grid::at(int x, int y) {
  if (x < 0 || y < 0 || x >= across * Tile::side || y >= down * Tile::side) return nullptr;
  const int tile_x = x / Tile::side, tile_y = y / Tile::side;
  auto& tile = tiles[static_cast<std::size_t>(tile_y) * static_cast<std::size_t>(across) +
                     static_cast<std::size_t>(tile_x)];
  if (!tile) tile = std::make_unique<Tile>();
  left = std::min(left, tile_x), right = std::max(right, tile_x);
  bottom = std::min(bottom, tile_y), top = std::max(top, tile_y);
  const int place = y % Tile::side * Tile::side + x % Tile::side;
  return &tile->pixels[static_cast<std::size_t>(place)];
}

RasterFrame Spread::Grid::frame() const {
  if (empty()) return {z, height, 0, 0, pixel, 0, 0};
  const auto pixels = [](int tile_count) { return static_cast<std::uint64_t>(tile_count) * Tile::side; };
  return {z,
          height,
          left * Tile::side * pixel - margin,
          bottom * Tile::side * pixel - margin,
          pixel,
          pixels(right - left + 1),
          pixels(top - bottom + 1)};
}

void Spread::Grid::read_row(std::uint64_t row, std::span<RasterPixel> pixels) const {
  const int y = static_cast<int>(row) + bottom * Tile::side;
  for (int tile_x = left; tile_x <= right; ++tile_x) {
    const auto& tile = tiles[static_cast<std::size_t>(y / Tile::side) * static_cast<std::size_t>(across) +
                             static_cast<std::size_t>(tile_x)];
    const auto place = pixels.begin() + (tile_x - left) * Tile::side;
    if (tile)
      std::copy_n(tile->pixels.begin() + y % Tile::side * Tile::side, Tile::side, place);
    else
      std::fill_n(place, Tile::side, RasterPixel{});
  }
}

Spread::Spread(const BedSize& bed, double finest_pixel, std::size_t feeders) : feeders_(feeders) {
  const double area = (bed.x + 2 * margin) * (bed.y + 2 * margin);
  grid_.pixel = std::max(finest_pixel, std::sqrt(area / most_pixels));
  grid_.across = tiles_for(bed.x, grid_.pixel, Tile::side);
  grid_.down = tiles_for(bed.y, grid_.pixel, Tile::side);
  grid_.tiles.resize(static_cast<std::size_t>(grid_.across) * static_cast<std::size_t>(grid_.down));
  grid_.clear();
}

std::vector<Spread::Offset> Spread::around(int a, int b) const {
  const int farthest = static_cast<int>(std::ceil(widest_radius * reach / grid_.pixel));
  std::vector<Offset> offsets;
  for (int y = -farthest; y <= farthest; ++y) {
    for (int x = -farthest; x <= farthest; ++x) {
      const double distance = std::hypot(x - 0.25 * a, y - 0.25 * b);
      if (distance <= farthest) offsets.push_back({x, y, distance});
    }
  }
  const auto scatter = [](const Offset& o) {
    return std::fmod(golden_angle * (37 * o.x + 101 * o.y + 9999), 1);
  };
  std::sort(offsets.begin(), offsets.end(), [&](const Offset& l, const Offset& r) {
    const auto square = [&](const Offset& o) {
      return (4 * o.x - a) * (4 * o.x - a) + (4 * o.y - b) * (4 * o.y - b);
    };
    return square(l) != square(r) ? square(l) < square(r) : scatter(l) < scatter(r);
  });
  return offsets;
}

void Spread::begin(double z, double height) {
  grid_.clear();
  grid_.z = z;
  grid_.height = height;
}

void Spread::lay(const Bead& bead, double width) {
  const double length = std::hypot(bead.to.x - bead.from.x, bead.to.y - bead.from.y);
  const double step = std::max(grid_.pixel, width / steps_per_width);
  const int steps = std::max(1, static_cast<int>(std::ceil(length / step)));
  const double amount = bead.volume / (grid_.height * grid_.pixel * grid_.pixel) / steps;
  const double radius = std::min(width / 2, widest_radius);
  for (int i = 0; i < steps; ++i) {
    const double part = (i + 0.5) / steps;
    drop(along(bead.from.x, bead.to.x, part), along(bead.from.y, bead.to.y, part), amount, radius,
         std::span(bead.shares).first(feeders_));
  }
}

Spread::Centre Spread::centre(double x, double y) {
  const double column = (x + margin) / grid_.pixel, row = (y + margin) / grid_.pixel;
  Centre at{static_cast<int>(std::floor(column)), static_cast<int>(std::floor(row)), 1, 1, false, nullptr};
  const double aside = column - std::floor(column) - 0.5, above = row - std::floor(row) - 0.5;
  at.right = aside < 0 ? -1 : 1;
  at.up = above < 0 ? -1 : 1;
  int a = static_cast<int>(std::lround(4 * std::abs(aside))),
      b = static_cast<int>(std::lround(4 * std::abs(above)));
  at.swapped = b > a;
  if (at.swapped) std::swap(a, b);
  std::vector<Offset>& offsets = offsets_[a][b];
  if (offsets.empty()) offsets = around(a, b);  // a printer that lays nothing needs none
  at.offsets = &offsets;
  return at;
}

RasterPixel* Spread::Centre::pixel(Grid& grid, const Offset& offset) const {
  const auto [along_x, along_y] = swapped ? std::pair(offset.y, offset.x) : std::pair(offset.x, offset.y);
  return grid.at(x + right * along_x, y + up * along_y);
}

/// `amount` is the number of pixels that it fills to the layer's height.
void Spread::drop(double x, double y, double amount, double radius, std::span<const double> shares) {
  const Centre at = centre(x, y);
  const double pixels = radius / grid_.pixel;
  const double left = fill_room(at, amount, std::max(1.0, pixels * reach), shares);
  if (left > 0) heap(at, left, std::max(0.5, pixels), shares);
}

/// Returns the amount that did not fit.
double Spread::fill_room(const Centre& at, double amount, double within, std::span<const double> shares) {
  for (const Offset& offset : *at.offsets) {
    if (offset.distance > within || amount <= 0) break;
    RasterPixel* pixel = at.pixel(grid_, offset);
    if (pixel == nullptr || pixel->fill >= full) continue;
    const double put = std::min(amount, 1.0 - pixel->fill);
    pixel->add(put, shares);
    amount -= put;
  }
  return amount;
}

void Spread::heap(const Centre& at, double amount, double within, std::span<const double> shares) {
  const auto end = std::find_if(at.offsets->begin(), at.offsets->end(),
                                [within](const Offset& offset) { return offset.distance > within; });
  // At least the pixel in which the place lies.
  const auto last = std::max(end, at.offsets->begin() + 1);
  const double each = amount / static_cast<double>(last - at.offsets->begin());
  for (auto offset = at.offsets->begin(); offset != last; ++offset) {
    if (RasterPixel* pixel = at.pixel(grid_, *offset))
      pixel->add(each, shares);
    else
      lost_ += each * grid_.height * grid_.pixel * grid_.pixel;
  }
}

}  // namespace unicursal::sim
