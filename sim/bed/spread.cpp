#include "sim/bed/spread.hpp"

#include <algorithm>
#include <cmath>

namespace unicursal::sim {

namespace {

constexpr double most_pixels = 16e6;    // pixels of the whole bed
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
  return &tile->pixels[static_cast<std::size_t>(y % Tile::side * Tile::side + x % Tile::side)];
}

RasterFrame Spread::Grid::frame() const {
  if (empty()) return {z, height, 0, 0, pixel, 0, 0};
  const auto pixels = [](int tile_count) { return static_cast<std::uint64_t>(tile_count * Tile::side); };
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
  const int farthest = static_cast<int>(std::ceil(widest_radius * reach / grid_.pixel));
  for (int y = -farthest; y <= farthest; ++y) {
    for (int x = -farthest; x <= farthest; ++x) {
      const double distance = std::hypot(x, y);
      if (distance <= farthest) offsets_.push_back({x, y, distance});
    }
  }
  const auto scatter = [](const Offset& o) {
    return std::fmod(golden_angle * (37 * o.x + 101 * o.y + 9999), 1);
  };
  std::sort(offsets_.begin(), offsets_.end(), [&](const Offset& a, const Offset& b) {
    const auto square = [](const Offset& o) { return o.x * o.x + o.y * o.y; };
    return square(a) != square(b) ? square(a) < square(b) : scatter(a) < scatter(b);
  });
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

/// `amount` is the number of pixels that it fills to the layer's height.
void Spread::drop(double x, double y, double amount, double radius, std::span<const double> shares) {
  const auto cell = [this](double mm) { return static_cast<int>(std::floor((mm + margin) / grid_.pixel)); };
  const int cx = cell(x), cy = cell(y);
  const double pixels = radius / grid_.pixel;
  const double left = fill_room(cx, cy, amount, std::max(1.0, pixels * reach), shares);
  if (left > 0) heap(cx, cy, left, std::max(0.5, pixels), shares);
}

/// Returns the amount that did not fit.
double Spread::fill_room(int cx, int cy, double amount, double within, std::span<const double> shares) {
  for (const Offset& offset : offsets_) {
    if (offset.distance > within || amount <= 0) break;
    RasterPixel* pixel = grid_.at(cx + offset.x, cy + offset.y);
    if (pixel == nullptr || pixel->fill >= full) continue;
    const double put = std::min(amount, 1.0 - pixel->fill);
    pixel->add(put, shares);
    amount -= put;
  }
  return amount;
}

void Spread::heap(int cx, int cy, double amount, double within, std::span<const double> shares) {
  const auto end = std::find_if(offsets_.begin(), offsets_.end(),
                                [within](const Offset& offset) { return offset.distance > within; });
  const double each = amount / static_cast<double>(end - offsets_.begin());
  for (auto offset = offsets_.begin(); offset != end; ++offset) {
    if (RasterPixel* pixel = grid_.at(cx + offset->x, cy + offset->y))
      pixel->add(each, shares);
    else
      lost_ += each * grid_.height * grid_.pixel * grid_.pixel;
  }
}

}  // namespace unicursal::sim
