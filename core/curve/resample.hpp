// Removes and adds vertices without changing the shape of a curve. mm.
#pragma once

#include "core/curve/curve.hpp"
#include "core/geometry/border_index.hpp"
#include "core/numeric/parallel.hpp"

namespace unicursal::core {

/// Removes vertices that are closer than half of `spacing` to a neighbour, if that moves the curve by less
/// than its clearance (so that it stays simple and inside). Where a segment or a hairpin is shorter than a
/// tenth of `spacing`, there is no clearance left; there it suffices that the corner that is cut off is
/// empty.
Curve thinned(const Curve& curve, const BorderIndex& border, double spacing, Workers* workers = nullptr);

/// Does the same as thinned(), and cuts segments longer than 1.5 `spacing` into equal pieces.
Curve respaced(const Curve& curve, const BorderIndex& border, double spacing, Workers* workers = nullptr);

/// The curve with every segment halved.
Curve subdivided(const Curve& curve);

}  // namespace unicursal::core
