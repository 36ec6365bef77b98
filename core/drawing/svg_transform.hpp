// Lists of transforms, in the grammar of SVG's attribute and in that of CSS (CSS Transforms Module Level 1):
// matrix, translate, scale, rotate, skew and their forms for one axis. Departure: both grammars are read as
// one, so that an attribute may have units and a style may leave them out.
#pragma once

#include <Eigen/Geometry>
#include <string_view>

#include "core/drawing/svg_frame.hpp"

namespace unicursal::core {

/// What the relative lengths of a transform refer to.
struct TransformFrame {
  Box box;                ///< the reference box, user units: percentages are shares of its size
  double font_size = 16;  ///< px
};

/// Angles without a unit are degrees. "none" and "" are the identity. Throws Malformed.
Eigen::Affine2d transform(std::string_view text, const TransformFrame& frame = {});

/// The point of `transform-origin`: one or two of left, center, right, top, bottom or lengths from the corner
/// of the reference box. Throws Malformed.
Vec2 transform_origin(std::string_view text, const TransformFrame& frame);

}  // namespace unicursal::core
