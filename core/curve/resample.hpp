// Vertices taken away and added without changing what a curve looks like. mm.
#pragma once

#include "core/curve/curve.hpp"
#include "core/geometry/border_index.hpp"
#include "core/numeric/parallel.hpp"

namespace unicursal::core {

/// Drops vertices that stand closer than half of `spacing` to their neighbours, where the curve moves by less
/// than its clearance (so it stays simple and inside). Where a segment or a hairpin has come down to a tenth
/// of it, there is no clearance left; then it is enough that nothing lies in the corner that is cut off.
Curve thinned(const Curve& curve, const BorderIndex& border, double spacing, Workers* workers = nullptr);

/// The same, and cuts segments longer than 1.5 `spacing` in equal pieces.
Curve respaced(const Curve& curve, const BorderIndex& border, double spacing, Workers* workers = nullptr);

/// Every segment halved.
Curve subdivided(const Curve& curve);

}  // namespace unicursal::core
