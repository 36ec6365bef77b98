// From a fillable region to a closed curve: the stages of the paper's Figure 2 in a row.
#pragma once

#include <optional>

#include "core/planner/island_work.hpp"

namespace unicursal::core {

/// One closed curve through the region, with the contours that the options ask for. If `by_material` is true,
/// each material gets its own curve where there is room, and the curves are joined. Returns nullopt if not
/// even a contour fits.
std::optional<RegionCurve> fill_region(const FillableRegion& part, bool by_material, IslandWork& work);

}  // namespace unicursal::core
