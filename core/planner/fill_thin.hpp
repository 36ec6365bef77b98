// A region with thin places: strands along their axes, a space-filling curve in each thick place, and all of
// it in one closed curve.
#pragma once

#include <functional>
#include <optional>

#include "core/planner/island_work.hpp"

namespace unicursal::core {

/// Fills a thick place.
using FillThick = std::function<std::optional<RegionCurve>(const FillableRegion&)>;

/// Returns nullopt if the region has no thin places, or if strands cannot be laid there and joined to the
/// rest.
std::optional<RegionCurve> fill_thin(const Polygon& region, IslandWork& work, const FillThick& fill_thick);

}  // namespace unicursal::core
