#include "core/picture/image.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace unicursal::picture {

Image::Image(std::size_t width, std::size_t height, Colour background)
    : width_(width), height_(height), pixels_(width * height, background) {
  assert(width >= 1 && height >= 1 && width <= 32768 && height <= 32768);
}

Colour Image::at(std::size_t x, std::size_t y) const {
  assert(x < width_ && y < height_);
  return pixels_[y * width_ + x];
}

void Image::set(std::size_t x, std::size_t y, Colour colour) {
  assert(x < width_ && y < height_);
  pixels_[y * width_ + x] = colour;
}

void Image::blend(std::ptrdiff_t x, std::ptrdiff_t y, Colour colour, double cover) {
  if (x < 0 || y < 0 || static_cast<std::size_t>(x) >= width_ || static_cast<std::size_t>(y) >= height_)
    return;
  Colour& pixel = pixels_[static_cast<std::size_t>(y) * width_ + static_cast<std::size_t>(x)];
  const double share = std::clamp(cover, 0.0, 1.0);
  const auto mix = [share](std::uint8_t under, std::uint8_t over) {
    return static_cast<std::uint8_t>(std::lround(under + share * (over - under)));
  };
  pixel = {mix(pixel.r, colour.r), mix(pixel.g, colour.g), mix(pixel.b, colour.b)};
}

void Image::stroke(double x0, double y0, double x1, double y1, double thickness, Colour colour) {
  const double reach = thickness / 2 + 1;
  const double dx = x1 - x0, dy = y1 - y0, length2 = dx * dx + dy * dy;
  const auto first = [](double v) { return static_cast<std::ptrdiff_t>(std::floor(std::max(v, -1.0))); };
  const auto last = [](double v, std::size_t n) {
    return static_cast<std::ptrdiff_t>(std::ceil(std::min(v, static_cast<double>(n))));
  };
  for (std::ptrdiff_t y = first(std::min(y0, y1) - reach); y <= last(std::max(y0, y1) + reach, height_);
       ++y) {
    for (std::ptrdiff_t x = first(std::min(x0, x1) - reach); x <= last(std::max(x0, x1) + reach, width_);
         ++x) {
      const double px = static_cast<double>(x) + 0.5 - x0, py = static_cast<double>(y) + 0.5 - y0;
      const double t = length2 > 0 ? std::clamp((px * dx + py * dy) / length2, 0.0, 1.0) : 0.0;
      const double cover = thickness / 2 + 0.5 - std::hypot(px - t * dx, py - t * dy);
      if (cover > 0) blend(x, y, colour, cover);
    }
  }
}

}  // namespace unicursal::picture
