// Short labels for diagrams: digits, Latin letters (as capitals) and . : / - % + on a grid of 3 × 5 dots.
#pragma once

#include <string_view>

#include "core/picture/image.hpp"

namespace unicursal::picture {

inline constexpr std::size_t glyph_width = 4, glyph_height = 5;  ///< dots, including the gap after the glyph

/// Writes with the upper left corner at (x, y); a dot is a square of `dot` pixels. Other characters leave a
/// blank, and parts outside the picture are not drawn.
void write(Image& image, std::ptrdiff_t x, std::ptrdiff_t y, std::string_view text, std::size_t dot,
           Colour colour);

}  // namespace unicursal::picture
