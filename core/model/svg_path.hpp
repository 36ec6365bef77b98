// The `d` attribute of an SVG path: M L H V C S Q T A Z, absolute and relative, with repeated arguments.
// Unlike a browser, which draws a damaged path up to the damage, this refuses it: half a shape must not
// print.
#pragma once

#include <string_view>

#include "core/model/outline.hpp"

namespace unicursal::core {

/// Draws the path. Throws Malformed naming the character where the text goes wrong. "" and "none" draw
/// nothing.
void draw_path(std::string_view text, Outline& outline);

}  // namespace unicursal::core
