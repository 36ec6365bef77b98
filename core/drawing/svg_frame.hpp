// Places an SVG drawing: lengths with units, transform lists, and the map from the root's user units to the
// part's frame (mm, y up, origin at the lower left corner of the page). One CSS pixel is 1/96 inch = 25.4/96
// mm.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string_view>

#include "core/geometry/polygon.hpp"
#include "core/text/wording.hpp"

namespace unicursal::core {

/// Converts a length to pixels (user units). `whole` is 100 %, px. Units: none, px, mm, cm, in, pt, pc, Q, %.
/// Throws Malformed for anything else.
double length(std::string_view text, double whole);

/// Parses a list of matrix, translate, scale, rotate, skewX, skewY, with angles in degrees. Throws Malformed.
Eigen::Affine2d transform(std::string_view text);

/// The attributes of the root element that place the drawing; empty where absent.
struct PageAttributes {
  std::string_view width, height, view_box, preserve_aspect_ratio;
};

struct Page {
  Eigen::Affine2d to_part = Eigen::Affine2d::Identity();  ///< user units → part frame, mm
  Vec2 size{0, 0};  ///< of the viewBox, user units; percentages of lengths refer to it
};

/// Throws Malformed for sizes that are not positive; warns if no attribute gives a physical size.
Page page(const PageAttributes& attributes, Warnings& warnings);

}  // namespace unicursal::core
