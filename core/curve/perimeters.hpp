// Contours along the border of a region, and what they leave to the fill (paper, end of §4.2). mm.
//
// Contour k runs (k − ½) bead widths inside the border as closed rings, round every hole as well. Where the
// region is narrower than two beads, a ring that kept that distance would run into itself; there it halves
// its distance: at a width b of less than two beads it runs b ÷ 4 inside either border, so that there and
// back fill b together. The paper proposes contours but does not say what becomes of thin places; this is
// ours.
#pragma once

#include <vector>

#include "core/curve/curve.hpp"
#include "core/geometry/region.hpp"

namespace unicursal::core {

struct Perimeters {
  std::vector<std::vector<Curve>> rings;  ///< [0] the outermost contour's rings, and so on inwards
  Region
      inside;  ///< what is left: more than 0.8 bead widths wide, and one bead width away from the last rings
};

/// At most `count` contours; fewer when nothing is left for more, and none when not even a ring of
/// `least_width` mm (the least that two beads side by side may take together) fits. Rings are simple,
/// disjoint and strictly inside `region`, but for rounding; callers check what they make of them.
Perimeters perimeters(const Polygon& region, int count, double bead_width, double least_width);

/// Is a piece between strands so large that it needs a curve of its own? All of a smaller one is within 1.15
/// bead widths of what runs half a bead outside it.
bool worth_a_curve(const Polygon& piece, double bead_width);

/// The region that one ring round `region` encloses, between its outer and its inner rings.
Region within_ring(const Polygon& region, double bead_width, double least_width);

}  // namespace unicursal::core
