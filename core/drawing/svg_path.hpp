// The `d` attribute of an SVG path: M L H V C S Q T A Z, absolute and relative, with repeated arguments. A
// damaged path is drawn up to the damage (SVG 1.1, section F.2).
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/drawing/outline.hpp"

namespace unicursal::core {

/// Draws the path. Returns the mistake before which the drawing ends, with the place of the first wrong
/// character. "" and "none" draw nothing. Throws TooFar.
std::optional<std::string> draw_path(std::string_view text, Outline& outline);

}  // namespace unicursal::core
