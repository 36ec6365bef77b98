// A picture that is drawn in the part's frame: mm and y up go in, pixels and y down come out.
#pragma once

#include "core/geometry/polygon.hpp"
#include "core/picture/image.hpp"

namespace unicursal::host {

/// How much of the part a picture shows, and how large.
struct CanvasSize {
  core::Box extent;         ///< mm
  double scale = 1;         ///< pixels per mm
  double least_width = 0;   ///< pixels; a narrower drawing is centred
  double caption_room = 0;  ///< pixels, left free below
};

class Canvas {
 public:
  /// With a margin of some pixels around the extent.
  Canvas(const CanvasSize& size, picture::Colour background);

  double scale() const { return scale_; }
  /// mm, the picture's upper left corner.
  const core::Vec2& origin() const { return origin_; }
  picture::Image& image() { return image_; }
  const picture::Image& image() const { return image_; }
  /// In pixels.
  core::Vec2 at(const core::Vec2& point) const;

  /// The inside of the polygon, by even-odd rule at pixel centres.
  void fill(const core::Polygon& polygon, picture::Colour colour);
  /// The border of the polygon, `thickness` pixels wide.
  void outline(const core::Polygon& polygon, double thickness, picture::Colour colour);
  /// A closed line, `thickness` pixels wide.
  void ring(const core::Ring& ring, double thickness, picture::Colour colour);
  /// A straight line, `thickness` pixels wide.
  void line(const core::Vec2& a, const core::Vec2& b, double thickness, picture::Colour colour);

 private:
  double scale_;
  picture::Image image_;
  core::Vec2 origin_;  ///< mm, where pixel (0, 0) begins
};

/// The scale at which a bead is `pixels_per_bead` wide, or less where the extent would need more than
/// `longest_side` pixels.
double scale_for(const core::Box& extent, double bead_width, double pixels_per_bead, double longest_side);

}  // namespace unicursal::host
