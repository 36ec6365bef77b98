#include "core/drawing/svg_frame.hpp"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "core/drawing/outline.hpp"
#include "core/geometry/clip.hpp"
#include "core/text/malformed.hpp"
#include "core/text/number_scanner.hpp"

namespace unicursal::core {
namespace {

constexpr double mm_per_px = 25.4 / 96;

struct AspectRatio {
  bool uniform = true;
  bool slice = false;    ///< the drawing covers the viewport instead of fitting into it
  Vec2 share{0.5, 0.5};  ///< of the free space, the part to the left of (above) the drawing
};

double share(std::string_view name) {
  return name == "Min" ? 0 : name == "Max" ? 1 : 0.5;
}

AspectRatio aspect_ratio(std::string_view text) {
  AspectRatio result;
  result.uniform = text.find("none") == std::string_view::npos;
  result.slice = text.find("slice") != std::string_view::npos;
  const auto x = text.find('x');
  if (x != std::string_view::npos && text.size() >= x + 8 && text[x + 4] == 'Y') {
    result.share = {share(text.substr(x + 1, 3)), share(text.substr(x + 5, 3))};
  }
  return result;
}

/// "", "auto" and percentages of an unknown window give no size.
std::optional<double> paper_length(std::string_view text) {
  if (text.empty() || text == "auto" || text.find('%') != std::string_view::npos) return std::nullopt;
  const double px = length(text, 0);
  if (!(px > 0)) throw Malformed("the drawing's width and height must be more than 0");
  return px;
}

}  // namespace

std::optional<double> px_per_unit(std::string_view unit, const LengthFrame& frame) {
  static constexpr std::array<std::pair<std::string_view, double>, 8> units{{{"", 1.0},
                                                                             {"px", 1.0},
                                                                             {"mm", 96 / 25.4},
                                                                             {"cm", 960 / 25.4},
                                                                             {"q", 24 / 25.4},
                                                                             {"in", 96.0},
                                                                             {"pt", 96.0 / 72},
                                                                             {"pc", 16.0}}};
  const std::string name = lower(unit);
  const auto found = std::find_if(units.begin(), units.end(), [&](const auto& u) { return u.first == name; });
  if (found != units.end()) return found->second;
  if (name == "rem") return frame.root_font_size;
  if (name == "%") return frame.whole / 100;
  if (name == "em") return frame.font_size;
  if (name == "ex" || name == "ch") return frame.font_size / 2;
  if (name == "vw") return frame.viewport.x() / 100;
  if (name == "vh") return frame.viewport.y() / 100;
  if (name == "vmin") return frame.viewport.minCoeff() / 100;
  if (name == "vmax") return frame.viewport.maxCoeff() / 100;
  return std::nullopt;
}

double length(std::string_view text, const LengthFrame& frame) {
  NumberScanner scanner(text);
  const double value = scanner.required();
  const std::string_view unit = scanner.peek() == '%' ? scanner.rest().substr(0, 1) : scanner.word();
  if (unit == "%") scanner.advance();
  scanner.skip_spaces();
  if (!scanner.at_end()) throw Malformed(in_quotes(text) + " is not a length");
  const auto px = px_per_unit(unit, frame);
  if (!px) throw Malformed("the unit " + in_quotes(unit) + " is not one of mm, cm, Q, in, pt, pc, px, em, %");
  return value * *px;
}

std::optional<Box> view_box(std::string_view text) {
  if (text.empty()) return std::nullopt;
  const std::vector<double> v = numbers(text);
  if (v.size() != 4) throw Malformed("the viewBox needs four numbers");
  if (!(v[2] > 0 && v[3] > 0)) throw Malformed("the viewBox has no area");
  return Box{{v[0], v[1]}, {v[0] + v[2], v[1] + v[3]}};
}

Eigen::Affine2d fitted(const Box& view, const Vec2& size, std::string_view preserve_aspect_ratio) {
  const AspectRatio how = aspect_ratio(preserve_aspect_ratio);
  Vec2 scale = size.cwiseQuotient(view.size());
  if (how.uniform) scale.setConstant(how.slice ? scale.maxCoeff() : scale.minCoeff());
  const Vec2 free = size - scale.cwiseProduct(view.size());
  const Vec2 corner = how.uniform ? Vec2(free.cwiseProduct(how.share)) : Vec2(0, 0);
  return Eigen::Translation2d(corner) * Eigen::Scaling(scale) * Eigen::Translation2d(-view.min);
}

Region mapped_box(const Eigen::Affine2d& map, const Box& box) {
  Ring ring{box.min, {box.max.x(), box.min.y()}, box.max, {box.min.x(), box.max.y()}};
  for (Vec2& p : ring) {
    p = map * p;
    if (!p.allFinite()) throw Malformed("it lies too far away");
  }
  ring = clipped(ring, Side::right, -farthest_coordinate);
  ring = clipped(ring, Side::left, farthest_coordinate);
  ring = clipped(ring, Side::above, -farthest_coordinate);
  ring = clipped(ring, Side::below, farthest_coordinate);
  return ring.size() < 3 ? Region{} : enclosed({ring}, FillRule::non_zero);
}

Page page(const PageAttributes& attributes, Warnings& warnings) {
  const std::optional<Box> view = view_box(attributes.view_box);
  const std::optional<double> width = paper_length(attributes.width),
                              height = paper_length(attributes.height);
  if (!width && !height) {
    warnings.add("the drawing has no width and height, so one unit is taken as a pixel of 1/96 inch");
  }
  const Vec2 natural = view ? view->size() : Vec2(100, 100);
  // A missing side follows from the other by the viewBox's proportions.
  const Vec2 paper(width.value_or(height ? *height * natural.x() / natural.y() : natural.x()),
                   height.value_or(width ? *width * natural.y() / natural.x() : natural.y()));
  const Box shown = view.value_or(Box{{0, 0}, paper});
  Eigen::Affine2d flip = Eigen::Affine2d::Identity();
  flip.matrix() << mm_per_px, 0, 0, 0, -mm_per_px, paper.y() * mm_per_px, 0, 0, 1;
  return {flip * fitted(shown, paper, attributes.preserve_aspect_ratio), shown.size(), paper * mm_per_px,
          view.has_value() || (width && height)};
}

}  // namespace unicursal::core
