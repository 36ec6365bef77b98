// Reads the filled shapes of an SVG 1.1 drawing: path, rect, circle, ellipse, polygon and polyline, in groups
// nested to any depth up to 256. Strokes, text, images, clones and clipping are not read. Coordinates are in
// the part's frame: mm, y up, origin at the lower left corner of the page.
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

/// Returns shapes in painter's order: later shapes cover earlier ones; may be empty. Throws FileError, or
/// ModelError naming line and element.
/// `turn` is applied before curves become polygons.
std::vector<Shape> read_svg(const std::filesystem::path& file, Warnings& warnings,
                            const Eigen::Matrix2d& turn = Eigen::Matrix2d::Identity());

}  // namespace unicursal::core
