// A colour picture to draw on and to write as PNG. Units: pixels, y down.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace unicursal::picture {

struct Colour {
  std::uint8_t r = 0, g = 0, b = 0;
  friend bool operator==(const Colour&, const Colour&) = default;
};

class Image {
 public:
  /// Precondition: both sides in 1…32768.
  Image(std::size_t width, std::size_t height, Colour background);

  std::size_t width() const { return width_; }
  std::size_t height() const { return height_; }

  Colour at(std::size_t x, std::size_t y) const;
  void set(std::size_t x, std::size_t y, Colour colour);
  /// Mixes `colour` over the pixel; `cover` in 0…1. Pixels outside the picture are ignored.
  void blend(std::ptrdiff_t x, std::ptrdiff_t y, Colour colour, double cover);
  /// Draws a straight stroke with round ends and smooth borders, `thickness` pixels wide.
  void stroke(double x0, double y0, double x1, double y1, double thickness, Colour colour);

 private:
  std::size_t width_, height_;
  std::vector<Colour> pixels_;
};

/// Throws std::system_error with the path if the file cannot be written.
void write_png(const std::filesystem::path& file, const Image& image);

}  // namespace unicursal::picture
