// The `d` attribute of an SVG path: M L H V C S Q T A Z, absolute and relative, with repeated arguments.
// A browser draws a damaged path up to the damage; this refuses it, because half a shape must not be printed.
#pragma once

#include <string_view>

#include "core/drawing/outline.hpp"

namespace unicursal::core {

/// Draws the path. Throws Malformed naming the first wrong character. "" and "none" draw nothing.
void draw_path(std::string_view text, Outline& outline);

}  // namespace unicursal::core
