// Contours and fill as one closed curve (paper, end of §4.2), in parts of several materials as well.
//
// One material: every contour goes all the way round. Several: each piece of a material follows its share of
// the island's outline, there and back within a band that is closed in itself, so an odd number of contours
// is rounded up; borders between materials get none. A piece is joined to its neighbours once, as without
// contours, so crossings stay 2 (k − 1) for k pieces.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "core/curve/curve.hpp"
#include "core/planner/fillable.hpp"

namespace unicursal::core {

/// A closed curve that fills a region, or nothing where that cannot be done.
using FillRegion = std::function<std::optional<Curve>(const FillableRegion&)>;

struct PerimeterOptions {
  int count = 0;          ///< contours, 1 or more
  double bead_width = 0;  ///< mm
  double half_width = 0;  ///< mm, half of the least width that can be laid, as for fillable()
};

struct Outlined {
  Curve curve;
  int perimeters = 0;  ///< contours really laid, where there are most; fewer than asked for when no more fit
};

/// One closed curve for `island`. `pieces` are its parts of one material each; a single one means all of it.
/// Nothing where a piece is too thin, cannot be filled, or cannot be joined to the others.
std::optional<Outlined> with_perimeters(const Polygon& island, const std::vector<Polygon>& pieces,
                                        const PerimeterOptions& options, const FillRegion& fill);

}  // namespace unicursal::core
