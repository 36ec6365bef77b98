// Connected Fermat spirals, after Zhao et al., "Connected Fermat Spirals for Layered Fabrication", 2016 (the
// paper's [ZGH*16]), written plainly for the comparison. mm.
//
// Contours lie half a bead width, one and a half, … inside the border. A Fermat spiral runs inwards along
// every second one and back along the others. So each two neighbouring contours are the two sides of a band
// that winds inwards, and the curve is the border of all bands together:
//
// 1. The bands: what lies between (2 k + ½) and (2 k + 1½) widths inside, each connected piece for itself.
// 2. The tree: bands that face each other across a gap of a bead width, joined at the least distance (minimum
//    spanning tree), from the largest outermost band inwards.
// 3. The spiral: each band is cut open beside the link that arrives from its parent, and the link to a child
//    leaves on the other side of the cut, so that a chain of bands becomes one spiral. Where bands branch,
//    each further child gets a link of its own (their insertion of a child's spiral into its parent).
// 4. The border of the whole is the closed curve.
//
// Simplifications against the original: links are as wide as a band and straight; the tree weighs distances
// only, while theirs prefers pairs of contours that face each other for long; and instead of their final
// Gauss-Newton optimisation of spacing and smoothness, corners are rounded and the curve is smoothed by a few
// explicit steps. Should bands close a ring in spite of the cuts, its border is joined to the rest.
#pragma once

#include "tests/bench/paper/method.hpp"

namespace unicursal::bench {

/// One closed line, or several where the island's contours fall apart.
Filling fermat_spirals(const core::Polygon& island, double bead_width);

}  // namespace unicursal::bench
