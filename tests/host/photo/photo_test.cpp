#include "host/photo/read_photo.hpp"

#include <zlib.h>

#include <catch2/catch.hpp>
#include <cmath>

#include "core/error.hpp"
#include "tests/camera/photo.hpp"
#include "tests/host/support/temp_folder.hpp"

namespace unicursal::host {
namespace {

/// Soft colours, so that a JPEG changes them little: red grows to the right, blue downwards.
camera::Photo slope(std::size_t width, std::size_t height) {
  camera::Photo photo{width, height, {}};
  for (std::size_t y = 0; y < height; ++y) {
    for (std::size_t x = 0; x < width; ++x) {
      photo.bytes.push_back(static_cast<std::uint8_t>(40 + 160 * x / width));
      photo.bytes.push_back(90);
      photo.bytes.push_back(static_cast<std::uint8_t>(30 + 180 * y / height));
    }
  }
  return photo;
}

void check_same_pixels(const Photo& read, const camera::Photo& written, int tolerance) {
  REQUIRE(read.width() == written.width);
  REQUIRE(read.height() == written.height);
  for (std::size_t y = 1; y < written.height; y += 7) {
    for (std::size_t x = 1; x < written.width; x += 5) {
      const auto wanted = written.at(x, y);
      CHECK(std::abs(read.at(x, y).r - wanted[0]) <= tolerance);
      CHECK(std::abs(read.at(x, y).g - wanted[1]) <= tolerance);
      CHECK(std::abs(read.at(x, y).b - wanted[2]) <= tolerance);
    }
  }
}

}  // namespace

TEST_CASE("PNG and JPEG files are read, and turned as their EXIF says") {
  const test::TempFolder folder;
  const camera::Photo photo = slope(61, 40);
  camera::write_photo(folder / "photo.png", photo);
  check_same_pixels(read_photo(folder / "photo.png"), photo, 0);
  for (int orientation = 1; orientation <= 8; ++orientation) {
    CAPTURE(orientation);
    camera::write_photo(folder / "photo.jpg", photo, 95, orientation);
    check_same_pixels(read_photo(folder / "photo.jpg"), photo, 6);
  }
}

TEST_CASE("Values between the middles of pixels are means of their neighbours") {
  Photo photo(2, 2);
  photo.at(0, 0) = {0, 0, 0}, photo.at(1, 0) = {255, 0, 0};
  photo.at(0, 1) = {0, 51, 0}, photo.at(1, 1) = {255, 255, 0};
  CHECK(photo.between({0.5, 0.5})[0] == Approx(0));
  CHECK(photo.between({1, 0.5})[0] == Approx(0.5));
  CHECK(photo.between({1, 1})[1] == Approx((51 + 255) / 4.0 / 255));
  CHECK(photo.between({1.5, 1.5})[1] == Approx(1));
  CHECK(photo.holds({1.5, 0.5}));
  CHECK_FALSE(photo.holds({1.6, 0.5}));
  CHECK_FALSE(photo.holds({0.4, 1}));
}

TEST_CASE("What is not a photo is refused with a remedy, wherever it is cut off") {
  const test::TempFolder folder;
  CHECK_THROWS_WITH(read_photo(folder / "none.jpg"), Catch::Contains("cannot be read"));
  CHECK_THROWS_WITH(read_photo(folder / "."), Catch::Contains("cannot be read"));
  folder.write("text.jpg", "not a photo");
  CHECK_THROWS_WITH(read_photo(folder / "text.jpg"), Catch::Contains("is not a JPEG or PNG picture"));
  folder.write("empty.jpg", "");
  CHECK_THROWS_AS(read_photo(folder / "empty.jpg"), core::DataError);
  folder.write("apple.heic", std::string("\0\0\0\x18", 4) + "ftypheic");
  CHECK_THROWS_WITH(read_photo(folder / "apple.heic"), Catch::Contains("is a HEIC picture; save it as JPEG"));
  for (const char* name : {"photo.jpg", "photo.png"}) {
    camera::write_photo(folder / name, slope(61, 40), 80, 6);
    const std::string whole = test::read_text(folder / name);
    for (std::size_t size = 2; size + 12 < whole.size(); size += 1 + size / 40) {
      CAPTURE(name, size);
      folder.write("cut", whole.substr(0, size));
      CHECK_THROWS_AS(read_photo(folder / "cut"), core::DataError);
    }
  }
}

TEST_CASE("A photo that claims to be huge is refused before it is read") {
  const test::TempFolder folder;
  camera::write_photo(folder / "photo.png", slope(61, 40));
  std::string bytes = test::read_text(folder / "photo.png");
  bytes[16] = bytes[20] = 0;
  bytes[17] = bytes[21] = 1;  // 65 536 and more on each side
  const unsigned long sum =
      ::crc32(0, reinterpret_cast<const Bytef*>(bytes.data()) + 12, 17);  // of the header's chunk
  for (std::size_t i = 0; i < 4; ++i) bytes[29 + i] = static_cast<char>(sum >> (24 - 8 * i));
  folder.write("huge.png", bytes);
  CHECK_THROWS_WITH(read_photo(folder / "huge.png"), Catch::Contains("200 million pixels"));
  camera::write_photo(folder / "photo.jpg", slope(61, 40));
  bytes = test::read_text(folder / "photo.jpg");
  const std::size_t frame = bytes.find("\xFF\xC0");
  REQUIRE(frame != std::string::npos);
  for (std::size_t i = 5; i < 9; ++i) bytes[frame + i] = static_cast<char>(i % 2 == 1 ? 0xF0 : 0);  // 61 440
  folder.write("huge.jpg", bytes);
  CHECK_THROWS_WITH(read_photo(folder / "huge.jpg"), Catch::Contains("200 million pixels"));
}

}  // namespace unicursal::host
