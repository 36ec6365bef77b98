#include "host/photo/exif.hpp"

#include <catch2/catch.hpp>
#include <string>
#include <vector>

namespace unicursal::host {
namespace {

using Bytes = std::vector<std::uint8_t>;

void put(Bytes& bytes, std::size_t value, std::size_t size, bool little) {
  for (std::size_t i = 0; i < size; ++i) {
    const std::size_t shift = 8 * (little ? i : size - 1 - i);
    bytes.push_back(static_cast<std::uint8_t>(value >> shift));
  }
}

/// A header, and a directory with the camera's make before the orientation.
Bytes tiff(std::size_t orientation, bool little) {
  Bytes bytes{static_cast<std::uint8_t>(little ? 'I' : 'M'), static_cast<std::uint8_t>(little ? 'I' : 'M')};
  put(bytes, 42, 2, little);
  put(bytes, 8, 4, little);
  put(bytes, 2, 2, little);
  for (const auto& [tag, type, value] :
       {std::tuple{0x010F, 2, std::size_t{0x41}}, std::tuple{0x0112, 3, orientation}}) {
    put(bytes, static_cast<std::size_t>(tag), 2, little);
    put(bytes, static_cast<std::size_t>(type), 2, little);
    put(bytes, 1, 4, little);
    put(bytes, value, 2, little);
    put(bytes, 0, 2, little);
  }
  put(bytes, 0, 4, little);
  return bytes;
}

/// The colours in rows, one letter each.
std::string rows(const Photo& photo) {
  std::string text;
  for (std::size_t y = 0; y < photo.height(); ++y) {
    for (std::size_t x = 0; x < photo.width(); ++x) text += static_cast<char>(photo.at(x, y).r);
    text += '/';
  }
  return text;
}

}  // namespace

TEST_CASE("The orientation is found in both orders of bytes") {
  for (std::size_t orientation = 1; orientation <= 8; ++orientation) {
    CHECK(orientation_in(tiff(orientation, true)) == static_cast<int>(orientation));
    CHECK(orientation_in(tiff(orientation, false)) == static_cast<int>(orientation));
  }
}

TEST_CASE("Damaged EXIF data leave a photo as it is") {
  CHECK(orientation_in({}) == 1);
  CHECK(orientation_in(tiff(9, true)) == 1);
  CHECK(orientation_in(tiff(0, false)) == 1);
  Bytes far = tiff(6, true);
  far[4] = far[5] = far[6] = far[7] = 0xFF;  // the directory begins beyond the end
  CHECK(orientation_in(far) == 1);
  Bytes many = tiff(6, true);
  many.resize(many.size() - 16);
  many[8] = many[9] = 0xFF;  // more entries than there are
  CHECK(orientation_in(many) == 1);
  const Bytes whole = tiff(6, false);
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const int seen = orientation_in(std::span(whole.data(), size));
    CHECK((seen == 1 || seen == 6));
  }
}

TEST_CASE("Each orientation turns the stored picture upright") {
  // Upright:  ab   As stored by a camera with each orientation, after the figures of the standard: the first
  //           cd   row of the file is the top, right, bottom … side of the scene.
  //           ef
  const char* const stored[] = {"ab/cd/ef/", "ba/dc/fe/", "fe/dc/ba/", "ef/cd/ab/",
                                "ace/bdf/",  "bdf/ace/",  "fdb/eca/",  "eca/fdb/"};
  for (int orientation = 1; orientation <= 8; ++orientation) {
    CAPTURE(orientation);
    const std::string text = stored[orientation - 1];
    const std::size_t width = text.find('/'), height = 6 / width;
    Photo photo(width, height);
    for (std::size_t y = 0; y < height; ++y) {
      for (std::size_t x = 0; x < width; ++x)
        photo.at(x, y).r = static_cast<std::uint8_t>(text[y * (width + 1) + x]);
    }
    CHECK(rows(upright(photo, orientation)) == "ab/cd/ef/");
  }
}

}  // namespace unicursal::host
