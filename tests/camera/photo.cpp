#include "tests/camera/photo.hpp"

#include <cstdio>
// libjpeg's header needs the types of <cstdio>.
#include <jpeglib.h>

#include <cassert>
#include <memory>
#include <stdexcept>

#include "core/picture/image.hpp"

namespace unicursal::camera {
namespace {

/// APP1 with one entry, the orientation, in big-endian TIFF (EXIF 2.3, 4.5.2 and 4.6).
std::array<std::uint8_t, 32> exif(int orientation) {
  return {'E',  'x',  'i', 'f', 0, 0,        // the segment's name
          'M',  'M',  0,   42,  0, 0, 0, 8,  // TIFF, first directory at 8
          0,    1,                           // one entry
          0x01, 0x12, 0,   3,   0, 0, 0, 1, 0, static_cast<std::uint8_t>(orientation), 0, 0,  // a short
          0,    0,    0,   0};  // no other directory
}

[[noreturn]] void refuse(j_common_ptr) {
  throw std::runtime_error("libjpeg cannot write a photo");
}

void write_jpeg(const std::filesystem::path& file, const Photo& photo, int quality, int orientation) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> out(std::fopen(file.c_str(), "wb"), &std::fclose);
  if (!out) throw std::runtime_error(file.string() + " cannot be written");
  jpeg_compress_struct jpeg{};
  jpeg_error_mgr errors{};
  jpeg.err = jpeg_std_error(&errors);
  errors.error_exit = refuse;
  jpeg_create_compress(&jpeg);
  jpeg_stdio_dest(&jpeg, out.get());
  jpeg.image_width = static_cast<JDIMENSION>(photo.width);
  jpeg.image_height = static_cast<JDIMENSION>(photo.height);
  jpeg.input_components = 3;
  jpeg.in_color_space = JCS_RGB;
  jpeg_set_defaults(&jpeg);
  jpeg_set_quality(&jpeg, quality, TRUE);
  jpeg.write_JFIF_header = FALSE;
  jpeg_start_compress(&jpeg, TRUE);
  const auto segment = exif(orientation);
  jpeg_write_marker(&jpeg, JPEG_APP0 + 1, segment.data(), static_cast<unsigned>(segment.size()));
  while (jpeg.next_scanline < jpeg.image_height) {
    auto* row = const_cast<std::uint8_t*>(&photo.bytes[3 * photo.width * jpeg.next_scanline]);
    jpeg_write_scanlines(&jpeg, &row, 1);
  }
  jpeg_finish_compress(&jpeg);
  jpeg_destroy_compress(&jpeg);
}

void write_as_png(const std::filesystem::path& file, const Photo& photo) {
  picture::Image image(photo.width, photo.height, {});
  for (std::size_t y = 0; y < photo.height; ++y) {
    for (std::size_t x = 0; x < photo.width; ++x) {
      const auto pixel = photo.at(x, y);
      image.set(x, y, {pixel[0], pixel[1], pixel[2]});
    }
  }
  picture::write_png(file, image);
}

}  // namespace

Photo stored(const Photo& upright, int orientation) {
  assert(orientation >= 1 && orientation <= 8);
  const bool lying = orientation >= 5;
  const std::size_t width = lying ? upright.height : upright.width;
  const std::size_t height = lying ? upright.width : upright.height;
  Photo turned{width, height, std::vector<std::uint8_t>(upright.bytes.size())};
  // Row 0 and column 0 of what is stored are these sides of the upright photo: 1 top and left, 2 top and
  // right, 3 bottom and right, 4 bottom and left, 5 left and top, 6 right and top, 7 right and bottom, 8 left
  // and bottom.
  const bool from_right = orientation == 2 || orientation == 3 || orientation == 6 || orientation == 7;
  const bool from_bottom = orientation == 3 || orientation == 4 || orientation == 7 || orientation == 8;
  for (std::size_t row = 0; row < height; ++row) {
    for (std::size_t column = 0; column < width; ++column) {
      std::size_t x = lying ? row : column, y = lying ? column : row;
      if (from_right) x = upright.width - 1 - x;
      if (from_bottom) y = upright.height - 1 - y;
      const std::uint8_t* from = &upright.bytes[3 * (y * upright.width + x)];
      std::uint8_t* to = &turned.bytes[3 * (row * width + column)];
      to[0] = from[0], to[1] = from[1], to[2] = from[2];
    }
  }
  return turned;
}

void write_photo(const std::filesystem::path& file, const Photo& upright, int quality, int orientation) {
  if (file.extension() == ".png") return write_as_png(file, upright);
  write_jpeg(file, stored(upright, orientation), quality, orientation);
}

}  // namespace unicursal::camera
