// The second stage of reading a drawing: elements → resolved styles. The cascade of SVG and CSS 2.1
// (section 6.4): values are inherited, then overridden by presentation attributes, by the rules of style
// sheets, by the entries of `style`, and at last by what is marked !important.
#pragma once

#include <optional>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/drawing/css_colour.hpp"
#include "core/drawing/css_sheet.hpp"
#include "core/drawing/stroke.hpp"
#include "core/drawing/svg_document.hpp"
#include "core/geometry/region.hpp"
#include "core/text/wording.hpp"

namespace unicursal::core {

/// A value of `fill` or `stroke`.
struct Paint {
  enum class Kind { none, colour, current_colour, server, context_fill, context_stroke };

  Kind kind = Kind::none;
  CssColour colour;                  ///< of kind colour; of a server: its fallback
  std::string server;                ///< id of a gradient or a pattern
  bool has_fallback = false;         ///< of a server
  bool fallback_is_none = false;     ///< of a server: the fallback is `none`
  bool fallback_is_current = false;  ///< of a server: the fallback is `currentColor`
};

/// What text looks like. Lengths in user units.
struct FontStyle {
  std::string families = "serif";  ///< as written, separated by commas
  double size = 16;
  int weight = 400;
  bool italic = false;
  double letter_spacing = 0, word_spacing = 0;
  enum class Anchor { start, middle, end } anchor = Anchor::start;
  bool keep_spaces = false;
  bool vertical = false;   ///< writing from top to bottom
  bool decorated = false;  ///< underlined or struck through
  enum class Baseline { alphabetic, middle, central, hanging, bottom } baseline = Baseline::alphabetic;
};

/// Properties that children inherit. Lengths in user units.
struct InheritedStyle {
  CssColour colour{"#000000", 1};  ///< the value of currentColor
  Paint fill{Paint::Kind::colour, {"#000000", 1}, {}, false, false};
  Paint stroke;
  double fill_opacity = 1, stroke_opacity = 1;
  FillRule fill_rule = FillRule::non_zero, clip_rule = FillRule::non_zero;
  StrokeStyle pen;
  bool visible = true;                               ///< from `visibility`: a child can become visible again
  std::string paint_order = "fsm";                   ///< of fill, stroke and markers
  std::string marker_start, marker_mid, marker_end;  ///< ids; empty: none
  FontStyle font;
};

struct Style : InheritedStyle {
  bool displayed = true;  ///< from `display`: false hides the whole subtree
  double opacity = 1;
  bool overflow_visible = false;
  std::string clip_path, mask;           ///< ids; empty: none
  std::string filter;                    ///< as written; empty: none
  std::string blend;                     ///< of mix-blend-mode; empty: normal
  std::optional<std::string> transform;  ///< of CSS; it replaces the attribute
  std::string transform_origin;          ///< as written; empty: the origin
  bool transform_box_is_fill_box = false;
  bool mask_by_alpha = false;
  bool stroke_keeps_width = false;  ///< vector-effect: non-scaling-stroke
  CssColour stop_colour{"#000000", 1};
  double stop_opacity = 1;
  double baseline_shift = 0;                                  ///< upwards
  std::vector<std::pair<std::string, std::string>> geometry;  ///< x, r, width, d …, given by CSS
};

/// What a style is resolved with.
struct StyleSource {
  const SvgDocument& document;
  const StyleSheet& sheet;
  Warnings& notes;
};

/// The style of `node` inside of an element of the style `parent`. `whole`: 100 % of lengths without a
/// direction, user units. Invalid values are skipped with a note. Throws Malformed as StyleSheet::matching
/// does.
Style styled(const pugi::xml_node& node, const InheritedStyle& parent, double whole,
             const StyleSource& source);

}  // namespace unicursal::core
