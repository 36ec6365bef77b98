// Gradients of a drawing (SVG 1.1, chapter 13): their stops and their direction. A gradient becomes one zone;
// what is known of it here serves to say which gradient of mixtures a job could give that zone.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <pugixml.hpp>
#include <string_view>
#include <vector>

#include "core/drawing/css_colour.hpp"
#include "core/drawing/svg_style.hpp"

namespace unicursal::core {

struct GradientStop {
  double offset = 0;  ///< from 0 to 1, not falling along the list
  CssColour colour;
};

struct Gradient {
  std::vector<GradientStop> stops;
  bool linear = true;
  bool by_box = true;  ///< `line` is in shares of the bounding box, else in user units
  Vec2 from{0, 0}, to{1, 0};
  Eigen::Affine2d transform = Eigen::Affine2d::Identity();

  /// The only colour, if all stops have the same.
  std::optional<CssColour> single_colour() const;
  /// The mean opacity along the gradient.
  double mean_alpha() const;
  /// The mean of luminance times opacity along the gradient.
  double mean_light() const;
};

bool is_gradient(std::string_view element_name);

/// Reads a gradient with what it takes over from others by links. `viewport`: 100 %, user units.
Gradient gradient(const pugi::xml_node& node, const Vec2& viewport, const StyleSource& source);

/// From 0 to 1: CSS Masking Module Level 1, section 6.2.
double luminance(const CssColour& colour);

}  // namespace unicursal::core
