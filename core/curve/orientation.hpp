// The orientation objectives (paper (42) to (53)): how far the directions of a curve are from an even
// distribution, as a squared Wasserstein distance on the circle of directions, rad².
//
// E_iso is 0 if every direction has an equal share of the length, and π²/12 if all segments have the same
// direction; E_aniso = π²/12 − E_iso. Departures from the paper: the gradient is exact, since it includes how
// the directions' shares change with the lengths, which (51) leaves out (also, Θ (49) already contains the π
// that (51) writes again). A segment counts as a whole for the zone in which its middle lies; it is not cut
// at the zone's border (10).
#pragma once

#include <cstddef>
#include <vector>

#include "core/curve/curve.hpp"
#include "core/geometry/polygon.hpp"
#include "core/numeric/parallel.hpp"

namespace unicursal::core {

/// One straight piece. Its angle counts modulo π, with its length as weight.
struct Stroke {
  double angle = 0;   ///< rad
  double length = 0;  ///< mm
};

/// E_iso (48), rad². Zero if the total length is zero.
double isotropy_distance(std::vector<Stroke> strokes);

/// Returns E_iso of the segments whose entry in `counts` is true (segment i leaves vertex i), rad², and adds
/// `weight` times its gradient to `gradient`. `workers` share the work; the result does not depend on them.
double isotropy_with_gradient(const Curve& curve, const std::vector<char>& counts, double weight,
                              std::vector<Vec2>& gradient, Workers* workers = nullptr);

}  // namespace unicursal::core
