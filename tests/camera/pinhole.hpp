// Where a camera sees the places of the bed: a pinhole behind a lens that distorts radially, after Brown
// ("Close-range camera calibration", 1971): a ray at the distance r from the axis, in focal lengths, arrives
// at r (1 + k1 r² + k2 r⁴). mm on the bed, pixels of the upright photo with y down; (0, 0) is the outer
// corner of the first pixel.
#pragma once

#include <array>
#include <cstddef>

#include "tests/camera/printed_layer.hpp"

namespace unicursal::camera {

/// Angles in radians.
struct View {
  double turn = 0;           ///< of the camera about its axis
  double slant = 0;          ///< between the axis and the bed's normal
  double slant_towards = 0;  ///< from where the camera looks: 0 from the right, π/2 from the back of the bed
  double framing = 0.8;      ///< share of the frame that the subject fills, in the tighter direction
  double k1 = 0, k2 = 0;
};

struct Place {
  double x = 0, y = 0;
};

class Pinhole {
 public:
  /// The camera is as near as `framing` allows.
  Pinhole(const View& view, std::size_t width, std::size_t height, const Rectangle& subject);

  /// Where the place of the bed is in the photo.
  Place pixel_of(const Place& place) const;
  /// The place of the bed that a pixel shows. Precondition: it shows the plane of the bed.
  Place place_of(const Place& pixel) const;
  /// The least rectangle around all that the photo shows, reckoned from its border.
  Rectangle visible() const;
  /// From the middle of the subject to the camera, length 1.
  std::array<double, 3> towards_camera() const { return towards_; }

 private:
  using Vector = std::array<double, 3>;

  void stand_at(double distance);
  double overhang(const Rectangle& subject) const;

  double width_, height_, focal_, k1_, k2_;
  Place middle_;
  Vector towards_{}, right_{}, down_{}, ahead_{}, eye_{};
};

}  // namespace unicursal::camera
