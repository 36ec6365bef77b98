// Reads an SVG drawing as areas of colour. The stages: `svg_document.hpp` (bytes → elements), `css_sheet.hpp`
// and `svg_style.hpp` (elements → resolved styles), `svg_scene.hpp` (→ painted areas), and here (→ shapes).
//
// Why a reader of our own: no library of Debian 12 gives the resolved geometry of a drawing together with
// colours, names and places. librsvg (2.54) resolves everything, but only renders; what it draws on a
// recording surface of cairo has lost the names that zones select, the lines for messages, and what it left
// out without a word. resvg's usvg gives resolved geometry, but is neither packaged as a library nor as a
// program. lib2geom has paths without drawings; Qt's and nanosvg's subsets of SVG have no style sheets, clip
// paths or masks. libcroco, the one library for style sheets that knew SVG's needs, has left Debian; litehtml
// styles pages of HTML only. So these are used for what they do whole: pugixml (XML), Clipper (booleans of
// areas), and fontconfig, HarfBuzz and FreeType (text). The tests hold the areas against pictures by librsvg.
//
// Source: SVG 1.1 (second edition), and of SVG 2 what programs for drawing write. Coordinates are in the
// part's frame: mm, y up, origin at the lower left corner of the page. What is drawn otherwise than a browser
// would is said in notes.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <filesystem>
#include <vector>

#include "core/drawing/drawn_gradient.hpp"
#include "core/drawing/shape.hpp"
#include "core/numeric/vec2.hpp"
#include "core/text/wording.hpp"

namespace unicursal::core {

struct DrawingOptions {
  Eigen::Matrix2d turn = Eigen::Matrix2d::Identity();  ///< applied before curves become polygons
  bool strokes_are_contours = false;  ///< lines that are not filled surround areas, instead of being areas
};

struct Drawing {
  std::vector<Shape> shapes;  ///< in painter's order: later shapes cover earlier ones; may be empty
  std::size_t lines = 0;      ///< thin ones, not filled, that could be contours
  Vec2 page{0, 0};            ///< mm; 0: the file does not say
  std::vector<DrawnGradient> gradients;  ///< linear ones, each as its first shape has it
};

/// Throws FileError, or ModelError with the line of the file.
Drawing read_svg(const std::filesystem::path& file, Warnings& warnings, const DrawingOptions& options = {});

}  // namespace unicursal::core
