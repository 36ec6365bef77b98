// Decides how an SVG element is filled: inherited values are overridden by presentation attributes, and these
// by the entries of `style`. Nothing else of CSS is supported; style sheets are not read.
#pragma once

#include <string>
#include <string_view>

#include "core/geometry/region.hpp"
#include "core/text/wording.hpp"

namespace unicursal::core {

struct Style {
  std::string fill = "#000000";    ///< "#rrggbb", "none", or "url(#…)" for a paint server without fallback
  std::string colour = "#000000";  ///< the value of currentColor
  FillRule rule = FillRule::non_zero;
  double fill_opacity = 1;
  bool visible = true;    ///< from `visibility`: a child can become visible again
  bool displayed = true;  ///< from `display`: false hides the whole subtree

  bool filled() const { return fill != "none" && fill_opacity > 0 && visible; }
};

/// Sets one property. Unknown properties are ignored; an invalid value is skipped with a warning that begins
/// with `where`.
void apply_property(Style& style, std::string_view name, std::string_view value, const std::string& where,
                    Warnings& warnings);

/// Sets the properties "name: value; …" of a style attribute; malformed ones are skipped with a warning.
void apply_style(Style& style, std::string_view text, const std::string& where, Warnings& warnings);

}  // namespace unicursal::core
