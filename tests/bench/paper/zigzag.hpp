// The zigzag of slicers, as in the paper's Figures 22 and 24: parallel rows one bead width apart, joined at
// their ends where the next row begins there, and a travel elsewhere. mm, radians.
//
// It is given its best: of `directions` directions the one with the fewest travels is taken, rows are spread
// so that the last one fits, and each line continues at the nearest end of another. There are no contours.
#pragma once

#include "tests/bench/paper/method.hpp"

namespace unicursal::bench {

Filling zigzag(const core::Polygon& island, double bead_width, int directions = 12);

}  // namespace unicursal::bench
