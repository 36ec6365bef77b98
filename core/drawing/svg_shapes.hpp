// SVG's basic shapes, drawn as paths. Lengths in user units.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/drawing/outline.hpp"

namespace unicursal::core {

/// Points separated by spaces or commas, closed or not. Returns the mistake before which the drawing ends.
std::optional<std::string> draw_points(std::string_view points, bool closed, Outline& outline);

/// Precondition: radii not negative. A radius of zero draws nothing.
void draw_ellipse(const Vec2& center, const Vec2& radii, Outline& outline);

struct RectShape {
  Vec2 corner{0, 0}, size{0, 0};
  std::optional<double> rx, ry;  ///< of rounded corners; one missing equals the other
};

/// Precondition: sizes not negative. A side of zero draws nothing.
void draw_rect(const RectShape& rect, Outline& outline);

}  // namespace unicursal::core
