// Lengths with units, viewports, and the map from the root's user units to the part's frame (mm, y up, origin
// at the lower left corner of the page). One CSS pixel is 1/96 inch = 25.4/96 mm. SVG 1.1, chapter 7.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string_view>

#include "core/geometry/polygon.hpp"
#include "core/geometry/region.hpp"
#include "core/text/wording.hpp"

namespace unicursal::core {

/// What relative lengths refer to, px.
struct LengthFrame {
  double whole = 0;            ///< 100 %
  double font_size = 16;       ///< of em; ex and ch are half of it
  Vec2 viewport{100, 100};     ///< of vw and vh: a hundredth of it
  double root_font_size = 16;  ///< of rem
};

/// Converts a length to pixels (user units). Units: none, px, mm, cm, in, pt, pc, Q, %, em, rem, ex, ch, vw,
/// vh, vmin, vmax. Throws Malformed for anything else.
double length(std::string_view text, const LengthFrame& frame);
inline double length(std::string_view text, double whole) {
  return length(text, LengthFrame{whole});
}

/// The lengths of one kind of unit in px; nullopt for an unknown unit.
std::optional<double> px_per_unit(std::string_view unit, const LengthFrame& frame);

/// Nullopt if `text` is empty. Throws Malformed for what is not four numbers, or has no area.
std::optional<Box> view_box(std::string_view text);

/// Maps `view` into a viewport of the size `size` with its corner in the origin, by preserveAspectRatio.
Eigen::Affine2d fitted(const Box& view, const Vec2& size, std::string_view preserve_aspect_ratio);

/// A box as an area of the part's frame. What lies farther than 100 m away is left out. Throws Malformed if
/// the map overflows.
Region mapped_box(const Eigen::Affine2d& map, const Box& box);

/// The attributes of the root element that place the drawing; empty where absent.
struct PageAttributes {
  std::string_view width, height, view_box, preserve_aspect_ratio;
};

struct Page {
  Eigen::Affine2d to_part = Eigen::Affine2d::Identity();  ///< user units → part frame, mm
  Vec2 size{0, 0};    ///< of the viewBox, user units; percentages of lengths refer to it
  Vec2 paper{0, 0};   ///< mm
  bool known = true;  ///< whether the file says how large the page is
};

/// Throws Malformed for sizes that are not positive; warns if no attribute gives a physical size.
Page page(const PageAttributes& attributes, Warnings& warnings);

}  // namespace unicursal::core
