// Which zone each stretch of a curve runs through (paper (9): the curve gets new vertices at zone borders).
#pragma once

#include <vector>

#include "core/curve/bead_path.hpp"
#include "core/curve/curve.hpp"
#include "core/model/part.hpp"

namespace unicursal::core {

/// Cuts the segments of `curve` at the borders of the island's zones. `areas` (mm², one per segment) are
/// divided in proportion to length, so that a bead keeps its width across the border.
BeadPath along_zones(const Curve& curve, const std::vector<double>& areas, const Island& island);

/// How often the closed path passes from one material to another.
std::size_t material_changes(const BeadPath& path, const std::vector<Zone>& zones);

}  // namespace unicursal::core
