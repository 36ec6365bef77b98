// One closed curve that fills a region with strands along a field of directions: a phase along the field, its
// zero lines as loops, and the loops merged into one.
//
//   if (const auto found = stripe_curve(region, field, {0.5, 1, {}})) use(found->curve);
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/curve/curve.hpp"
#include "core/field/direction_field.hpp"
#include "core/geometry/polygon.hpp"
#include "core/numeric/step_budget.hpp"

namespace unicursal::core {

struct StripeOptions {
  double bead_width = 0;          ///< mm, the distance of the strands
  std::uint64_t seed = 0;         ///< moves joints between equally good places
  MayContinue may_continue = {};  ///< asked between the solves for the phase
};

struct StripeCurve {
  Curve curve;               ///< simple and strictly inside the region
  std::vector<Curve> loops;  ///< from which it was merged
};

/// Returns nullopt if the region is not for stripes: too large, or with places that loops do not reach or
/// that cannot be joined.
std::optional<StripeCurve> stripe_curve(const Polygon& region, const DirectionField& field,
                                        const StripeOptions& options);

/// The area that is more than 1.1 bead widths away from the curve, thin places included, mm².
double bare_area(const Curve& curve, const Polygon& region, double bead_width);

}  // namespace unicursal::core
