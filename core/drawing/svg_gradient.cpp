#include "core/drawing/svg_gradient.hpp"

#include <algorithm>
#include <charconv>
#include <string>

#include "core/drawing/svg_frame.hpp"
#include "core/drawing/svg_transform.hpp"
#include "core/text/malformed.hpp"
#include "core/text/number_scanner.hpp"

namespace unicursal::core {
namespace {

constexpr std::size_t longest_chain = 32;  ///< of gradients that take over from each other

/// The mean of a value that changes evenly between the stops, and is constant outside of them.
template <class Value>
double mean(const std::vector<GradientStop>& stops, const Value& value) {
  if (stops.empty()) return 0;
  double sum = stops.front().offset * value(stops.front().colour);
  for (std::size_t i = 1; i < stops.size(); ++i) {
    sum +=
        (stops[i].offset - stops[i - 1].offset) * (value(stops[i].colour) + value(stops[i - 1].colour)) / 2;
  }
  return sum + (1 - stops.back().offset) * value(stops.back().colour);
}

double share(std::string_view text) {
  NumberScanner scanner(text);
  const double value = scanner.required();
  return std::clamp(scanner.peek() == '%' ? value / 100 : value, 0.0, 1.0);
}

std::vector<GradientStop> stops_of(const pugi::xml_node& node, const StyleSource& source) {
  std::vector<GradientStop> result;
  const Style own = styled(node, {}, 0, source);
  for (const pugi::xml_node& child : node.children()) {
    if (source.document.name(child) != "stop") continue;
    const Style style = styled(child, own, 0, source);
    GradientStop stop{0, style.stop_colour};
    stop.colour.alpha *= style.stop_opacity;
    try {
      stop.offset = share(child.attribute("offset").value());
    } catch (const Malformed&) {
      stop.offset = 0;
    }
    if (!result.empty()) stop.offset = std::max(stop.offset, result.back().offset);
    result.push_back(stop);
  }
  return result;
}

}  // namespace

std::optional<CssColour> Gradient::single_colour() const {
  if (stops.empty()) return std::nullopt;
  if (linear && from == to) return stops.back().colour;
  const CssColour& first = stops.front().colour;
  const bool same = std::all_of(stops.begin(), stops.end(), [&](const GradientStop& stop) {
    return stop.colour.rgb == first.rgb && stop.colour.alpha == first.alpha;
  });
  return same ? std::optional(first) : std::nullopt;
}

double Gradient::mean_alpha() const {
  return mean(stops, [](const CssColour& colour) { return colour.alpha; });
}

double Gradient::mean_light() const {
  return mean(stops, [](const CssColour& colour) { return colour.alpha * luminance(colour); });
}

bool is_gradient(std::string_view element_name) {
  return element_name == "linearGradient" || element_name == "radialGradient";
}

Gradient gradient(const pugi::xml_node& node, const Vec2& viewport, const StyleSource& source) {
  std::vector<pugi::xml_node> chain;
  for (pugi::xml_node link = node; link && chain.size() < longest_chain;
       link = source.document.linked(link)) {
    if (!is_gradient(source.document.name(link)) ||
        std::find(chain.begin(), chain.end(), link) != chain.end())
      break;
    chain.push_back(link);
  }
  const auto given = [&](const char* name) -> std::string_view {
    for (const pugi::xml_node& link : chain) {
      if (const auto attribute = link.attribute(name)) return attribute.value();
    }
    return {};
  };
  Gradient result;
  result.linear = source.document.name(node) == "linearGradient";
  result.by_box = given("gradientUnits") != "userSpaceOnUse";
  const auto coordinate = [&](const char* name, double otherwise, double whole) {
    const std::string_view text = given(name);
    return text.empty() ? otherwise * whole : length(text, result.by_box ? 1 : whole);
  };
  try {
    const Vec2 whole = result.by_box ? Vec2(1, 1) : viewport;
    result.from = {coordinate("x1", 0, whole.x()), coordinate("y1", 0, whole.y())};
    result.to = {coordinate("x2", 1, whole.x()), coordinate("y2", 0, whole.y())};
    result.transform = transform(given("gradientTransform"));
  } catch (const Malformed& problem) {
    source.notes.add(source.document.where(node) + ": " + problem.what());
  }
  for (const pugi::xml_node& link : chain) {
    result.stops = stops_of(link, source);
    if (!result.stops.empty()) break;
  }
  return result;
}

double luminance(const CssColour& colour) {
  unsigned rgb = 0;
  std::from_chars(colour.rgb.data() + 1, colour.rgb.data() + colour.rgb.size(), rgb, 16);
  return (0.2125 * (rgb >> 16U & 255U) + 0.7154 * (rgb >> 8U & 255U) + 0.0721 * (rgb & 255U)) / 255;
}

}  // namespace unicursal::core
