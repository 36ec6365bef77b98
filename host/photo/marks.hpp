// The round marks by which a test print is found in a photo: a disk within a ring. However the camera is
// turned or slanted, both stay nearly concentric ellipses, which hardly anything else in a photo is. mm.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "core/geometry/polygon.hpp"

namespace unicursal::host {

/// The radii of a mark that is drawn with lines of some width.
struct MarkSizes {
  explicit MarkSizes(double line) : disk(2.5 * line), ring_inner(5 * line), ring_outer(7 * line) {}

  double disk, ring_inner, ring_outer;
};

/// Six marks surround a test print. Their order is front left, front right, back right, back left: the
/// corners of a rectangle; then one on the front edge, a third of the way from the left, and one in the
/// middle of the back edge. The two show how the print is turned, and whether the four belong together.
inline constexpr std::size_t mark_count = 6;
using MarkPlaces = std::array<core::Vec2, mark_count>;

/// `box` is the rectangle of the four corners.
MarkPlaces mark_places(const core::Box& box);

/// The mark as open lines of the nozzle, `line` wide.
std::vector<std::vector<core::Vec2>> mark_strokes(const core::Vec2& centre, double line);

}  // namespace unicursal::host
