// How even the beads of a path are, over windows along the path.
#pragma once

#include <vector>

#include "core/curve/bead_path.hpp"

namespace unicursal::core {

/// Standard deviation ÷ mean of area ÷ length over consecutive windows of `window` mm along the closed path
/// (the last one, if cut short, is left out). Zero for a path shorter than two windows.
double width_variation(const BeadPath& path, double window);

/// Per bead, mm: area ÷ length of the stretch of `window` mm along the closed path around the bead's middle.
/// A bead's own width says little where it is short. Shorter paths have one width throughout.
std::vector<double> widths_around(const BeadPath& path, double window);

}  // namespace unicursal::core
