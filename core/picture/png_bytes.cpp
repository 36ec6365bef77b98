#include "core/picture/png_bytes.hpp"

#include <png.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <system_error>
#include <vector>

namespace unicursal::picture {

std::string png_bytes(const Image& image) {
  std::vector<png_byte> samples;
  samples.reserve(image.width() * image.height() * 3);
  for (std::size_t y = 0; y < image.height(); ++y) {
    for (std::size_t x = 0; x < image.width(); ++x) {
      const Colour c = image.at(x, y);
      samples.insert(samples.end(), {c.r, c.g, c.b});
    }
  }
  png_image png;
  std::memset(&png, 0, sizeof png);
  png.version = PNG_IMAGE_VERSION;
  png.width = static_cast<png_uint_32>(image.width());
  png.height = static_cast<png_uint_32>(image.height());
  png.format = PNG_FORMAT_RGB;
  std::string bytes(PNG_IMAGE_PNG_SIZE_MAX(png), '\0');
  png_alloc_size_t size = bytes.size();
  if (png_image_write_to_memory(&png, bytes.data(), &size, 0, samples.data(), 0, nullptr) == 0)
    throw std::system_error(ENOMEM, std::generic_category(), "a picture");
  bytes.resize(size);
  return bytes;
}

void write_png(const std::filesystem::path& file, const Image& image) {
  const std::string bytes = png_bytes(image);
  errno = 0;
  std::ofstream stream(file, std::ios::binary);
  const bool opened = stream.is_open();
  stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  stream.close();
  if (stream) return;
  const std::system_error problem(errno != 0 ? errno : EIO, std::generic_category(), file.string());
  std::error_code ignored;
  if (opened && std::filesystem::is_regular_file(file, ignored)) std::filesystem::remove(file, ignored);
  throw problem;
}

}  // namespace unicursal::picture
