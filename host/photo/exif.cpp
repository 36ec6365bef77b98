#include "host/photo/exif.hpp"

#include <optional>

namespace unicursal::host {
namespace {

constexpr std::size_t orientation_tag = 0x0112, entry_size = 12;

/// Numbers in the order of bytes that the header names. Reading beyond the end gives nothing.
class Tiff {
 public:
  explicit Tiff(std::span<const std::uint8_t> bytes) : bytes_(bytes) {
    little_ = bytes.size() >= 2 && bytes[0] == 'I' && bytes[1] == 'I';
  }

  std::optional<std::size_t> number(std::size_t at, std::size_t size) const {
    if (at > bytes_.size() || bytes_.size() - at < size) return std::nullopt;
    std::size_t value = 0;
    for (std::size_t i = 0; i < size; ++i) value = value << 8 | bytes_[at + (little_ ? size - 1 - i : i)];
    return value;
  }

 private:
  std::span<const std::uint8_t> bytes_;
  bool little_ = false;
};

}  // namespace

int orientation_in(std::span<const std::uint8_t> bytes) {
  const Tiff tiff(bytes);
  if (tiff.number(2, 2) != 42) return 1;
  const auto directory = tiff.number(4, 4);
  if (!directory) return 1;
  const auto entries = tiff.number(*directory, 2);
  for (std::size_t i = 0; entries && i < *entries; ++i) {
    const std::size_t entry = *directory + 2 + entry_size * i;
    const auto tag = tiff.number(entry, 2), value = tiff.number(entry + 8, 2);
    if (!tag || !value) return 1;
    if (*tag == orientation_tag) return *value >= 1 && *value <= 8 ? static_cast<int>(*value) : 1;
  }
  return 1;
}

Photo upright(Photo photo, int orientation) {
  if (orientation == 1) return photo;
  const bool lies = orientation >= 5;  // its sides change places
  const std::size_t width = photo.width(), height = photo.height();
  Photo turned(lies ? height : width, lies ? width : height);
  for (std::size_t y = 0; y < height; ++y) {
    for (std::size_t x = 0; x < width; ++x) {
      const std::size_t right = width - 1 - x, below = height - 1 - y;
      const std::size_t places[8][2] = {{x, y}, {right, y}, {right, below}, {x, below},
                                        {y, x}, {below, x}, {below, right}, {y, right}};
      const auto& [to_x, to_y] = places[orientation - 1];
      turned.at(to_x, to_y) = photo.at(x, y);
    }
  }
  return turned;
}

}  // namespace unicursal::host
