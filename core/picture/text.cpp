#include "core/picture/text.hpp"

#include <array>
#include <cctype>

namespace unicursal::picture {

namespace {

struct Glyph {
  char character;
  std::array<const char*, glyph_height> rows;
};

constexpr std::array<Glyph, 42> glyphs{{
    {'0', {"###", "# #", "# #", "# #", "###"}}, {'1', {" # ", "## ", " # ", " # ", "###"}},
    {'2', {"###", "  #", "###", "#  ", "###"}}, {'3', {"###", "  #", " ##", "  #", "###"}},
    {'4', {"# #", "# #", "###", "  #", "  #"}}, {'5', {"###", "#  ", "###", "  #", "###"}},
    {'6', {"###", "#  ", "###", "# #", "###"}}, {'7', {"###", "  #", "  #", " # ", " # "}},
    {'8', {"###", "# #", "###", "# #", "###"}}, {'9', {"###", "# #", "###", "  #", "###"}},
    {'A', {" # ", "# #", "###", "# #", "# #"}}, {'B', {"## ", "# #", "## ", "# #", "## "}},
    {'C', {" ##", "#  ", "#  ", "#  ", " ##"}}, {'D', {"## ", "# #", "# #", "# #", "## "}},
    {'E', {"###", "#  ", "## ", "#  ", "###"}}, {'F', {"###", "#  ", "## ", "#  ", "#  "}},
    {'G', {" ##", "#  ", "# #", "# #", " ##"}}, {'H', {"# #", "# #", "###", "# #", "# #"}},
    {'I', {"###", " # ", " # ", " # ", "###"}}, {'J', {"  #", "  #", "  #", "# #", " # "}},
    {'K', {"# #", "# #", "## ", "# #", "# #"}}, {'L', {"#  ", "#  ", "#  ", "#  ", "###"}},
    {'M', {"# #", "###", "###", "# #", "# #"}}, {'N', {"## ", "# #", "# #", "# #", "# #"}},
    {'O', {" # ", "# #", "# #", "# #", " # "}}, {'P', {"## ", "# #", "## ", "#  ", "#  "}},
    {'Q', {" # ", "# #", "# #", "## ", " ##"}}, {'R', {"## ", "# #", "## ", "# #", "# #"}},
    {'S', {" ##", "#  ", " # ", "  #", "## "}}, {'T', {"###", " # ", " # ", " # ", " # "}},
    {'U', {"# #", "# #", "# #", "# #", "###"}}, {'V', {"# #", "# #", "# #", "# #", " # "}},
    {'W', {"# #", "# #", "###", "###", "# #"}}, {'X', {"# #", "# #", " # ", "# #", "# #"}},
    {'Y', {"# #", "# #", " # ", " # ", " # "}}, {'Z', {"###", "  #", " # ", "#  ", "###"}},
    {'.', {"   ", "   ", "   ", "   ", " # "}}, {':', {"   ", " # ", "   ", " # ", "   "}},
    {'/', {"  #", "  #", " # ", "#  ", "#  "}}, {'-', {"   ", "   ", "###", "   ", "   "}},
    {'%', {"# #", "  #", " # ", "#  ", "# #"}}, {'+', {"   ", " # ", "###", " # ", "   "}},
}};

const Glyph* glyph_of(char character) {
  const char capital = static_cast<char>(std::toupper(static_cast<unsigned char>(character)));
  for (const Glyph& glyph : glyphs) {
    if (glyph.character == capital) return &glyph;
  }
  return nullptr;
}

void square(Image& image, std::ptrdiff_t x, std::ptrdiff_t y, std::size_t side, Colour colour) {
  for (std::size_t dy = 0; dy < side; ++dy) {
    for (std::size_t dx = 0; dx < side; ++dx) {
      image.blend(x + static_cast<std::ptrdiff_t>(dx), y + static_cast<std::ptrdiff_t>(dy), colour, 1);
    }
  }
}

}  // namespace

void write(Image& image, std::ptrdiff_t x, std::ptrdiff_t y, std::string_view text, std::size_t dot,
           Colour colour) {
  const auto step = static_cast<std::ptrdiff_t>(dot);
  for (const char character : text) {
    if (const Glyph* glyph = glyph_of(character)) {
      for (std::size_t row = 0; row < glyph_height; ++row) {
        for (std::size_t column = 0; column + 1 < glyph_width; ++column) {
          if (glyph->rows[row][column] != '#') continue;
          square(image, x + static_cast<std::ptrdiff_t>(column) * step,
                 y + static_cast<std::ptrdiff_t>(row) * step, dot, colour);
        }
      }
    }
    x += static_cast<std::ptrdiff_t>(glyph_width) * step;
  }
}

}  // namespace unicursal::picture
