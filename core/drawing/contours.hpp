// Drawings for laser cutters have no areas: their lines are the contours. Here such lines become areas.
#pragma once

#include <cstddef>
#include <vector>

#include "core/drawing/outline.hpp"
#include "core/geometry/region.hpp"

namespace unicursal::core {

/// mm: ends of lines that are closer than this are joined.
inline constexpr double joining_distance = 0.05;

struct Enclosed {
  Region region;
  std::size_t open = 0;  ///< lines that lead nowhere, and are left out
};

/// What an odd number of lines surrounds. Lines are joined at their ends where they meet.
Enclosed enclosed_by(const std::vector<Subpath>& lines);

}  // namespace unicursal::core
