// A photo, as a camera or a phone has taken it. Pixels, y down; pixel (x, y) covers x … x + 1.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "core/numeric/vec2.hpp"
#include "core/picture/lab.hpp"

namespace unicursal::host {

class Photo {
 public:
  /// Precondition: both sides ≥ 1.
  Photo(std::size_t width, std::size_t height) : width_(width), height_(height), pixels_(width * height) {}

  std::size_t width() const { return width_; }
  std::size_t height() const { return height_; }

  /// As the camera has encoded it (sRGB).
  const picture::Colour& at(std::size_t x, std::size_t y) const { return pixels_[y * width_ + x]; }
  picture::Colour& at(std::size_t x, std::size_t y) { return pixels_[y * width_ + x]; }

  /// At least half a pixel from the edge.
  bool holds(const core::Vec2& place) const;
  /// The encoded values, 0…1, between the middles of pixels. Precondition: holds(place).
  std::array<double, 3> between(const core::Vec2& place) const;

 private:
  std::size_t width_, height_;
  std::vector<picture::Colour> pixels_;
};

}  // namespace unicursal::host
