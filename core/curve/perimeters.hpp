// Contours along the border of a region, and the area that they leave to the fill (paper, end of §4.2). mm.
//
// Contour k runs (k − ½) bead widths inside the border as closed rings, also around every hole. Where the
// region is narrower than two beads, a ring at that distance would run into itself. There it comes closer to
// the border: in a place of width b it runs b ÷ 4 inside either border, so that its runs there and back fill
// b together. The paper proposes contours but does not treat thin places; this solution is ours.
#pragma once

#include <vector>

#include "core/curve/curve.hpp"
#include "core/geometry/region.hpp"

namespace unicursal::core {

struct Perimeters {
  std::vector<std::vector<Curve>> rings;  ///< [0] are the rings of the outermost contour, and so on inwards
  Region
      inside;  ///< the area left to the fill: one bead width inside the last rings, over 0.8 bead widths wide
};

/// At most `count` contours. There are fewer if no area is left for more, and none if not even a ring fits
/// whose two sides together take `least_width` mm. Rings are simple, disjoint and strictly inside `region`,
/// except for rounding; callers check the curves that they make of them.
Perimeters perimeters(const Polygon& region, int count, double bead_width, double least_width);

/// Whether a piece between strands is so large that it needs a curve of its own. All points of a smaller one
/// are within 1.15 bead widths of the strands that run half a bead outside it.
bool worth_a_curve(const Polygon& piece, double bead_width);

/// The area that one contour of `region` encloses, between its outer and its inner rings.
Region within_ring(const Polygon& region, double bead_width, double least_width);

}  // namespace unicursal::core
