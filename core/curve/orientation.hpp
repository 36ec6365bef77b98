// The orientation objectives (paper (42) to (53)): how far the directions of a curve are from being spread
// evenly, as a squared Wasserstein distance on the circle of directions, rad².
//
// E_iso is 0 when every direction has its equal share of the length and π²/12 when all segments run alike;
// E_aniso = π²/12 − E_iso. Departures from the paper: the gradient is exact, it includes how the shares of
// the directions change with the lengths, which (51) leaves out (and Θ (49) already holds the π that (51)
// writes again). A segment counts as a whole where its middle is, instead of being cut at the zone's border
// (10).
#pragma once

#include <cstddef>
#include <vector>

#include "core/curve/curve.hpp"
#include "core/geometry/polygon.hpp"

namespace unicursal::core {

/// One straight piece: its angle modulo π counts, with its length as weight.
struct Stroke {
  double angle = 0;   ///< rad
  double length = 0;  ///< mm
};

/// E_iso (48), rad². Zero for no length at all.
double isotropy_distance(std::vector<Stroke> strokes);

/// E_iso of those segments of a curve whose entry in `counts` is true (segment i leaves vertex i); adds
/// `weight` times its gradient. mm, rad².
double isotropy_with_gradient(const Curve& curve, const std::vector<char>& counts, double weight,
                              std::vector<Vec2>& gradient);

}  // namespace unicursal::core
