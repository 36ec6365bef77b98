// A photo and its file. Pixels are the stored bytes of sRGB, red first, rows from the top.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace unicursal::camera {

struct Photo {
  std::size_t width = 0, height = 0;
  std::vector<std::uint8_t> bytes;

  std::array<std::uint8_t, 3> at(std::size_t x, std::size_t y) const {
    const std::uint8_t* pixel = &bytes[3 * (y * width + x)];
    return {pixel[0], pixel[1], pixel[2]};
  }
};

/// The photo as a camera stores it that notes the orientation 1 to 8 of EXIF 2.3, table 4.6.4: a reader that
/// turns it accordingly gets the upright photo.
Photo stored(const Photo& upright, int orientation);

/// Writes a baseline JPEG with halved colour and an EXIF segment, or, if the name ends in .png, a PNG
/// without. Throws std::runtime_error if the file cannot be written.
void write_photo(const std::filesystem::path& file, const Photo& upright, int quality = 90,
                 int orientation = 1);

}  // namespace unicursal::camera
