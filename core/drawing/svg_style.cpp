#include "core/drawing/svg_style.hpp"

#include <algorithm>
#include <optional>

#include "core/drawing/css_colour.hpp"
#include "core/text/malformed.hpp"
#include "core/text/number_scanner.hpp"

namespace unicursal::core {
namespace {

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r\n\f");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r\n\f") - first + 1);
}

/// Splits at `separator`, but not inside parentheses (url(data:…;…)).
std::string_view take_entry(std::string_view& text) {
  int depth = 0;
  std::size_t end = 0;
  for (; end < text.size() && (text[end] != ';' || depth > 0); ++end) {
    if (text[end] == '(') ++depth;
    if (text[end] == ')') depth = std::max(0, depth - 1);
  }
  const std::string_view entry = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return trimmed(entry);
}

std::optional<std::string> paint(std::string_view value, const Style& style) {
  if (value == "none") return "none";
  if (value == "currentColor" || value == "currentcolor") return style.colour;
  if (value.substr(0, 4) != "url(") return css_colour(value);
  const auto end = value.find(')');
  if (end == std::string_view::npos) return std::nullopt;
  const std::string_view fallback = trimmed(value.substr(end + 1));
  if (fallback == "none") return "none";
  if (const auto colour = css_colour(fallback)) return colour;
  return std::string(value.substr(0, end + 1));
}

std::optional<double> opacity(std::string_view value) {
  try {
    NumberScanner scanner(value);
    return scanner.required();
  } catch (const Malformed&) {
    return std::nullopt;
  }
}

/// Returns false if the value is invalid; unknown properties are ignored and give true.
bool apply(Style& style, std::string_view name, std::string_view value) {
  if (value == "inherit") return true;
  if (name == "fill") {
    const auto fill = paint(value, style);
    if (fill) style.fill = *fill;
    return fill.has_value();
  }
  if (name == "color") {
    const auto colour = css_colour(value);
    if (colour) style.colour = *colour;
    return colour.has_value();
  }
  if (name == "fill-opacity") {
    const auto share = opacity(value);
    if (share) style.fill_opacity = *share;
    return share.has_value();
  }
  if (name == "fill-rule") {
    style.rule = value == "evenodd" ? FillRule::even_odd : FillRule::non_zero;
    return value == "evenodd" || value == "nonzero";
  }
  if (name == "display") style.displayed = value != "none";
  if (name == "visibility") style.visible = value == "visible";
  return true;
}

}  // namespace

void apply_property(Style& style, std::string_view name, std::string_view value, const std::string& where,
                    Warnings& warnings) {
  value = trimmed(value);
  const auto important = value.find('!');
  if (important != std::string_view::npos) value = trimmed(value.substr(0, important));
  if (!apply(style, name, value)) {
    warnings.add(where + ": " + std::string(name) + " cannot be " + in_quotes(value) + "; it is skipped");
  }
}

void apply_style(Style& style, std::string_view text, const std::string& where, Warnings& warnings) {
  while (!text.empty()) {
    const std::string_view entry = take_entry(text);
    if (entry.empty()) continue;
    const auto colon = entry.find(':');
    if (colon == std::string_view::npos || trimmed(entry.substr(0, colon)).empty()) {
      warnings.add(where + ": the style entry " + in_quotes(entry) + " is malformed; it is skipped");
      continue;
    }
    apply_property(style, trimmed(entry.substr(0, colon)), entry.substr(colon + 1), where, warnings);
  }
}

}  // namespace unicursal::core
