// How an SVG element is filled: presentation attributes, overridden by the entries of `style`, over what the
// parent passes down. Of CSS only this; style sheets are not read.
#pragma once

#include <string>
#include <string_view>

#include "core/geometry/region.hpp"
#include "core/text/wording.hpp"

namespace unicursal::core {

struct Style {
  std::string fill = "#000000";    ///< "#rrggbb", "none", or "url(#…)" for a paint server without fallback
  std::string colour = "#000000";  ///< what currentColor stands for
  FillRule rule = FillRule::non_zero;
  double fill_opacity = 1;
  bool visible = true;    ///< of `visibility`: a child can be visible again
  bool displayed = true;  ///< of `display`: false hides the whole subtree

  bool filled() const { return fill != "none" && fill_opacity > 0 && visible; }
};

/// Takes over one property if it is known and its value sound; an unsound value is skipped with a warning
/// that begins with `where`.
void apply_property(Style& style, std::string_view name, std::string_view value, const std::string& where,
                    Warnings& warnings);

/// Takes over the entries "name: value; …" of a style attribute; malformed ones are skipped with a warning.
void apply_style(Style& style, std::string_view text, const std::string& where, Warnings& warnings);

}  // namespace unicursal::core
