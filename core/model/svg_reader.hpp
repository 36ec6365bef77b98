// Filled shapes of an SVG drawing (1.1, the static part that has an area): path, rect, circle, ellipse,
// polygon, polyline, inside any nesting of groups. Strokes, text, images, clones and clipping are not read.
// Coordinates come out in the part's frame: mm, y up, origin at the page's lower left corner.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/geometry/region.hpp"
#include "core/text/wording.hpp"

namespace unicursal::core {

struct Shape {
  Region region;                   ///< never empty
  std::string fill;                ///< as computed: "#rrggbb", or "url(#…)"
  std::vector<std::string> names;  ///< id, label and name of the element, then those of the groups around it
};

/// In painter's order: later shapes cover earlier ones; may be empty. Throws FileError, and ModelError naming
/// line and element.
std::vector<Shape> read_svg(const std::filesystem::path& file, Warnings& warnings);

}  // namespace unicursal::core
