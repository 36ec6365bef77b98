// How even the beads of a path are, over windows along the path.
#pragma once

#include <vector>

#include "core/curve/bead_path.hpp"

namespace unicursal::core {

/// Standard deviation ÷ mean of the bead width (area ÷ length) over consecutive windows of `window` mm along
/// the closed path; a shorter rest at the end is left out. Zero for a path shorter than two windows.
double width_variation(const BeadPath& path, double window);

/// The mean bead width around each bead, mm: area ÷ length of the stretch of `window` mm along the closed
/// path around the bead's middle. (The own width of a short bead says little.) A path shorter than the window
/// has one width.
std::vector<double> widths_around(const BeadPath& path, double window);

}  // namespace unicursal::core
