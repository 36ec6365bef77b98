// How a camera sees the bed: a plane in perspective, through a lens whose distortion grows with the second
// and fourth power of the distance from the middle of the photo (Brown, "Close-Range Camera Calibration",
// 1971, radial terms). Bed: mm, y up. Photo: pixels, y down.
#pragma once

#include <array>
#include <vector>

#include "core/geometry/polygon.hpp"

namespace unicursal::host {

class View {
 public:
  /// Free numbers: where the lens would show the corners of `box` without its distortion, and the distortion.
  static constexpr std::size_t freedoms = 10;
  using Numbers = std::array<double, freedoms>;

  /// `corners` in the photo of the corners of `box`, counter-clockwise on the bed from its least one.
  /// Precondition: no three of them lie on a line. `size` of the photo.
  View(const core::Box& box, const std::array<core::Vec2, 4>& corners, const core::Vec2& size);

  core::Vec2 pixel_of(const core::Vec2& place) const;
  /// Pixels for a step of 1 mm on the bed: along x, along y.
  std::array<core::Vec2, 2> steps_at(const core::Vec2& place) const;
  /// Pixels per mm: the least over all directions.
  double scale_at(const core::Vec2& place) const;
  /// Whether the bed is seen from above, as a whole.
  bool possible() const;

  const Numbers& numbers() const { return numbers_; }
  void set(const Numbers& numbers);

 private:
  void solve();

  core::Box box_;
  core::Vec2 middle_;
  double half_diagonal_;
  Numbers numbers_{};
  std::array<double, 8> plane_{};  ///< the matrix of the perspective, row by row; its last number is 1
};

/// The photo shows `place` of the bed at `pixel`. Only the distance along `normal` (of length 1, in the
/// photo) is known, or with a normal of 0 both coordinates. `doubt`: standard deviation, pixels.
struct Sighting {
  core::Vec2 place{0, 0}, pixel{0, 0}, normal{0, 0};
  double doubt = 1;
};

/// Moves the view so that it agrees with the sightings. Sightings that are far off count less. `lens`: how
/// many numbers of the lens's distortion are free, 0 to 2. Returns the root mean square of what remains, in
/// doubts, over sightings that are not far off.
double fit_view(View& view, const std::vector<Sighting>& sightings, std::size_t lens);

}  // namespace unicursal::host
