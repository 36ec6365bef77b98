// Colours in CSS notation: the 148 names, #rgb, #rrggbb (and #rgba, #rrggbbaa), rgb(), hsl(), hwb() with and
// without alpha, transparent, and the names of a desktop's colours (CSS Color Module Level 4).
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace unicursal::core {

struct CssColour {
  std::string rgb;   ///< "#rrggbb" in lower case
  double alpha = 1;  ///< 0: transparent
};

/// Returns nullopt if `text` is not a colour. Case does not matter.
std::optional<CssColour> read_css_colour(std::string_view text);

/// Returns "#rrggbb" in lower case, "none" for a fully transparent colour, or nullopt if `text` is not a
/// colour. Partly transparent colours count as opaque.
std::optional<std::string> css_colour(std::string_view text);

}  // namespace unicursal::core
