// The outlines of text: fontconfig finds the fonts of this computer, HarfBuzz chooses and places the glyphs,
// and FreeType reads their outlines. Only installed fonts are read, never one that a drawing brings along.
// One object serves one thread.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/drawing/outline.hpp"
#include "core/text/wording.hpp"

namespace unicursal::core {

struct FontRequest {
  std::string families;  ///< as in CSS, separated by commas
  int weight = 400;      ///< 100 to 900
  bool italic = false;

  bool operator==(const FontRequest&) const = default;
};

/// A glyph of a line of text; lengths in shares of the font's size, y up.
struct Glyph {
  std::size_t face = 0;
  unsigned index = 0;
  Vec2 offset{0, 0};        ///< from the pen to the glyph's origin
  double advance = 0;       ///< of the pen
  std::size_t cluster = 0;  ///< offset in the text of the first byte that it stands for
};

/// Heights above the base line, in shares of the font's size.
struct FontHeights {
  double ascent = 0.8, descent = -0.2, x_height = 0.5;
};

class Fonts {
 public:
  explicit Fonts(Warnings& notes);
  ~Fonts();
  Fonts(const Fonts&) = delete;
  Fonts& operator=(const Fonts&) = delete;

  /// Lays out one line of UTF-8 in one direction. Characters that the font lacks come from another one; a
  /// note is added if none has them, or if the family that is asked for is not installed.
  std::vector<Glyph> line(std::string_view text, const FontRequest& request);
  FontHeights heights(const FontRequest& request);
  /// Draws a glyph, mapped by `place` from shares of the font's size to the outline's user units.
  void draw(const Glyph& glyph, const Eigen::Affine2d& place, Outline& outline) const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace unicursal::core
