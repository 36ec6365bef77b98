// Contours and fill as one closed curve (paper, end of §4.2), also for parts of several materials.
//
// With one material, every contour goes all the way round. With several, each material's piece traces its
// part of the island's outline out and back in a closed band, so the number of contours is rounded up to an
// even one; borders between materials get no contours. Each piece is joined to its neighbours once, as
// without contours, so that the curve still crosses borders 2 (k − 1) times for k pieces.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "core/curve/curve.hpp"
#include "core/planner/fillable.hpp"

namespace unicursal::core {

/// Returns a closed curve that fills a region, or nullopt if that cannot be done.
using FillFunction = std::function<std::optional<Curve>(const FillableRegion&)>;

struct PerimeterOptions {
  int count = 0;          ///< contours, 1 or more
  double bead_width = 0;  ///< mm
  double half_width = 0;  ///< half the least width that can be laid, mm, as for fillable()
};

struct Outlined {
  Curve curve;
  int perimeters = 0;  ///< contours laid, where there are most; fewer than asked for if no more fit
};

/// One closed curve for `island`. `pieces` are its parts of one material each; a single piece stands for the
/// whole island. Returns nullopt if a piece is too thin, cannot be filled, or cannot be joined to the others.
std::optional<Outlined> with_perimeters(const Polygon& island, const std::vector<Polygon>& pieces,
                                        const PerimeterOptions& options, const FillFunction& fill);

}  // namespace unicursal::core
