#include "host/report/deposit_pictures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

namespace unicursal::host {
namespace {

using picture::Colour;

constexpr std::size_t longest_side = 1600;  // pixels
constexpr Colour paper{255, 255, 255};
constexpr Colour full{236, 234, 226};
constexpr Colour empty{18, 32, 74};
constexpr Colour heaped{214, 58, 18};
constexpr Colour mark{214, 0, 150};
constexpr Colour border{40, 40, 44};
constexpr double reddest = 0.5;    // layer heights too much at which the colour ends
constexpr double paleness = 0.45;  // of right mixtures
constexpr std::size_t hatch = 6;   // picture pixels from stripe to stripe

Colour mix(const Colour& a, const Colour& b, double part) {
  const auto between = [part](std::uint8_t from, std::uint8_t to) {
    return static_cast<std::uint8_t>(std::lround(from + std::clamp(part, 0.0, 1.0) * (to - from)));
  };
  return {between(a.r, b.r), between(a.g, b.g), between(a.b, b.b)};
}

/// Raster pixels to a picture pixel, in each direction.
std::size_t block_of(const PixelGrid& grid) {
  return (std::max(grid.columns, grid.rows) + longest_side - 1) / longest_side;
}

/// Averages blocks of raster pixels to picture pixels, y down.
picture::Image draw(const PixelGrid& grid,
                    const std::function<Colour(std::size_t pixel, std::size_t x, std::size_t y)>& colour_of) {
  const std::size_t block = block_of(grid);
  picture::Image image((grid.columns + block - 1) / block, (grid.rows + block - 1) / block, paper);
  for (std::size_t y = 0; y < image.height(); ++y) {
    for (std::size_t x = 0; x < image.width(); ++x) {
      std::array<std::size_t, 3> sum{};
      std::size_t count = 0;
      for (std::size_t r = y * block; r < std::min((y + 1) * block, grid.rows); ++r) {
        for (std::size_t c = x * block; c < std::min((x + 1) * block, grid.columns); ++c) {
          const Colour colour = colour_of((grid.rows - 1 - r) * grid.columns + c, x, y);
          sum[0] += colour.r, sum[1] += colour.g, sum[2] += colour.b;
          ++count;
        }
      }
      const auto mean = [count](std::size_t s) { return static_cast<std::uint8_t>(s / count); };
      image.set(x, y, {mean(sum[0]), mean(sum[1]), mean(sum[2])});
    }
  }
  return image;
}

bool at_border(const DepositView& view, std::size_t i) {
  const auto differs = [&](std::size_t j) {
    return j < view.labels.size() && view.labels[j] != outside_all && view.labels[j] != view.labels[i];
  };
  return view.labels[i] != outside_all && (differs(i + 1) || differs(i + view.grid.columns));
}

Colour arrived(const DepositView& view, std::size_t i) {
  std::array<double, sim::RasterPixel::feeders> shares{};
  for (std::size_t f = 0; f < shares.size(); ++f) shares[f] = view.pixels[i].share(f);
  return mix(paper, picture::colour_of(shares, view.filaments), view.pixels[i].fill);
}

}  // namespace

PicturePlace place_of(const PixelGrid& grid) {
  const core::Vec2 up(0, static_cast<double>(grid.rows) * grid.pixel);
  return {grid.origin + up, grid.pixel * static_cast<double>(block_of(grid))};
}

picture::Image draw_gaps(const DepositView& view) {
  return draw(view.grid, [&](std::size_t i, std::size_t, std::size_t) {
    const double fill = view.pixels[i].fill;
    if (view.labels[i] == outside_all) return mix(paper, heaped, fill / 2);
    return fill < 1 ? mix(empty, full, fill) : mix(full, heaped, (fill - 1) / reddest);
  });
}

picture::Image draw_mixtures(const DepositView& view) {
  return draw(view.grid, [&](std::size_t i, std::size_t x, std::size_t y) {
    if (view.labels[i] == outside_all) return paper;
    if (at_border(view, i)) return border;
    if (!view.wrong[i]) return mix(arrived(view, i), paper, paleness);
    return (x + y) % hatch < hatch / 3 ? mark : arrived(view, i);
  });
}

}  // namespace unicursal::host
