#include "core/drawing/svg_frame.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "core/text/malformed.hpp"
#include "core/text/number_scanner.hpp"

namespace unicursal::core {
namespace {

constexpr double mm_per_px = 25.4 / 96;

double px_per_unit(std::string_view unit, double whole) {
  static constexpr std::array<std::pair<std::string_view, double>, 8> units{{{"", 1.0},
                                                                             {"px", 1.0},
                                                                             {"mm", 96 / 25.4},
                                                                             {"cm", 960 / 25.4},
                                                                             {"Q", 24 / 25.4},
                                                                             {"in", 96.0},
                                                                             {"pt", 96.0 / 72},
                                                                             {"pc", 16.0}}};
  if (unit == "%") return whole / 100;
  const auto found = std::find_if(units.begin(), units.end(), [&](const auto& u) { return u.first == unit; });
  if (found == units.end()) {
    throw Malformed("the unit " + in_quotes(unit) + " is not one of mm, cm, Q, in, pt, pc, px, %");
  }
  return found->second;
}

double radians(double degrees) {
  return degrees * std::numbers::pi / 180;
}

Eigen::Affine2d linear_map(double a, double b, double c, double d, double e, double f) {
  Eigen::Affine2d map;
  map.matrix() << a, c, e, b, d, f, 0, 0, 1;
  return map;
}

Eigen::Affine2d rotation(const std::vector<double>& v) {
  const Eigen::Affine2d turn(Eigen::Rotation2Dd(radians(v[0])));
  if (v.size() == 1) return turn;
  const Vec2 center(v[1], v[2]);
  return Eigen::Translation2d(center) * turn * Eigen::Translation2d(-center);
}

Eigen::Affine2d single_transform(std::string_view name, const std::vector<double>& v) {
  const std::size_t n = v.size();
  if (name == "matrix" && n == 6) return linear_map(v[0], v[1], v[2], v[3], v[4], v[5]);
  if (name == "translate" && (n == 1 || n == 2)) return linear_map(1, 0, 0, 1, v[0], n == 2 ? v[1] : 0);
  if (name == "scale" && (n == 1 || n == 2)) return linear_map(v[0], 0, 0, v[n - 1], 0, 0);
  if (name == "rotate" && (n == 1 || n == 3)) return rotation(v);
  if (name == "skewX" && n == 1) return linear_map(1, 0, std::tan(radians(v[0])), 1, 0, 0);
  if (name == "skewY" && n == 1) return linear_map(1, std::tan(radians(v[0])), 0, 1, 0, 0);
  throw Malformed(fmt::format("the transform {} with {} numbers is unknown", in_quotes(name), n));
}

std::vector<double> arguments(NumberScanner& scanner) {
  scanner.skip_spaces();
  if (scanner.peek() != '(') throw Malformed("a transform lacks its opening parenthesis");
  scanner.advance();
  std::vector<double> values;
  scanner.skip_spaces();
  while (scanner.peek() != ')') {
    values.push_back(scanner.required());
    scanner.skip_spaces();
  }
  scanner.advance();
  return values;
}

struct Alignment {
  bool uniform = true;
  bool slice = false;    ///< the drawing covers the page instead of fitting into it
  Vec2 share{0.5, 0.5};  ///< of the free space, the part to the left of (above) the drawing
};

double share(std::string_view name) {
  return name == "Min" ? 0 : name == "Max" ? 1 : 0.5;
}

Alignment alignment(std::string_view text) {
  Alignment result;
  result.uniform = text.find("none") == std::string_view::npos;
  result.slice = text.find("slice") != std::string_view::npos;
  const auto x = text.find('x');
  if (x != std::string_view::npos && text.size() >= x + 8 && text[x + 4] == 'Y') {
    result.share = {share(text.substr(x + 1, 3)), share(text.substr(x + 5, 3))};
  }
  return result;
}

/// Maps the viewBox to the page (px, y down). `preserve_aspect_ratio` as in SVG 1.1, section 7.8.
Eigen::Affine2d fitted(const Box& view, const Vec2& paper, const Alignment& how) {
  Vec2 scale = paper.cwiseQuotient(view.size());
  if (how.uniform) scale.setConstant(how.slice ? scale.maxCoeff() : scale.minCoeff());
  const Vec2 free = paper - scale.cwiseProduct(view.size());
  const Vec2 corner = how.uniform ? Vec2(free.cwiseProduct(how.share)) : Vec2(0, 0);
  return Eigen::Translation2d(corner) * Eigen::Scaling(scale) * Eigen::Translation2d(-view.min);
}

std::optional<Box> view_box(std::string_view text) {
  if (text.empty()) return std::nullopt;
  const std::vector<double> v = numbers(text);
  if (v.size() != 4) throw Malformed("the viewBox needs four numbers");
  if (!(v[2] > 0 && v[3] > 0)) throw Malformed("the viewBox has no area");
  return Box{{v[0], v[1]}, {v[0] + v[2], v[1] + v[3]}};
}

/// "", "auto" and percentages of an unknown window give no size.
std::optional<double> paper_length(std::string_view text) {
  if (text.empty() || text == "auto" || text.find('%') != std::string_view::npos) return std::nullopt;
  const double px = length(text, 0);
  if (!(px > 0)) throw Malformed("the drawing's width and height must be more than 0");
  return px;
}

}  // namespace

double length(std::string_view text, double whole) {
  NumberScanner scanner(text);
  const double value = scanner.required();
  const std::string_view unit = scanner.peek() == '%' ? scanner.rest().substr(0, 1) : scanner.word();
  if (unit == "%") scanner.advance();
  scanner.skip_spaces();
  if (!scanner.at_end()) throw Malformed(in_quotes(text) + " is not a length");
  return value * px_per_unit(unit, whole);
}

Eigen::Affine2d transform(std::string_view text) {
  Eigen::Affine2d result = Eigen::Affine2d::Identity();
  NumberScanner scanner(text);
  scanner.skip_separator();
  while (!scanner.at_end()) {
    const std::string_view name = scanner.word();
    if (name.empty()) throw Malformed("a transform should start at " + in_quotes(scanner.rest()));
    result = result * single_transform(name, arguments(scanner));
    scanner.skip_separator();
  }
  return result;
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
  return {flip * fitted(shown, paper, alignment(attributes.preserve_aspect_ratio)), shown.size()};
}

}  // namespace unicursal::core
