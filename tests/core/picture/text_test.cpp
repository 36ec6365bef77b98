#include <catch2/catch.hpp>

#include <set>
#include <string>

#include "core/picture/text.hpp"

using namespace unicursal::picture;

namespace {

constexpr Colour paper{255, 255, 255}, ink{0, 0, 0};

std::string dots(char character) {
  Image image(glyph_width, glyph_height, paper);
  write(image, 0, 0, std::string(1, character), 1, ink);
  std::string result;
  for (std::size_t y = 0; y < image.height(); ++y) {
    for (std::size_t x = 0; x < image.width(); ++x) result += image.at(x, y) == ink ? '#' : ' ';
  }
  return result;
}

}  // namespace

TEST_CASE("every character has its own shape, with a gap after it") {
  std::set<std::string> seen;
  const std::string all = "0123456789abcdefghijklmnpqrstuvwxyz./:-%+";
  for (const char character : all) {
    const std::string shape = dots(character);
    CHECK(shape.find('#') != std::string::npos);
    for (std::size_t row = 0; row < glyph_height; ++row)
      CHECK(shape[row * glyph_width + glyph_width - 1] == ' ');
    seen.insert(shape);
  }
  CHECK(seen.size() == all.size());
  CHECK(dots('a') == dots('A'));
  CHECK(dots('~').find('#') == std::string::npos);
}

TEST_CASE("text that leaves the picture is cut off") {
  Image image(10, 10, paper);
  write(image, -5, 7, "8888", 3, ink);
  CHECK(image.at(0, 9) == ink);
}
