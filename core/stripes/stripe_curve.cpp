#include "core/stripes/stripe_curve.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "core/curve/clearance.hpp"
#include "core/curve/join.hpp"
#include "core/geometry/border_index.hpp"
#include "core/geometry/lattice.hpp"
#include "core/geometry/lattice_owners.hpp"
#include "core/stripes/merge.hpp"
#include "core/stripes/phase.hpp"
#include "core/stripes/stripe_grid.hpp"
#include "core/stripes/zero_lines.hpp"

namespace unicursal::core {
namespace {

constexpr double most_nodes = 1'000'000;  ///< more would take more than a gigabyte
constexpr std::size_t fewest_vertices = 5;

constexpr double bare = 1.1;  ///< bead widths; a point farther from the curve is bare
constexpr double samples_per_width = 4;
constexpr double most_left_out = 6, left_out_share = 0.01;  ///< bead widths, and share: of loops out of reach
// Square bead widths, and share of the region, that may be bare before fairing, which fills corners and the
// gaps where loops are joined.
constexpr double most_bare = 2, bare_share = 0.01;

bool simple_inside(const Curve& curve, const BorderIndex& border) {
  return curve.size() >= fewest_vertices && self_intersections(curve) == 0 &&
         segments_outside(curve, border) == 0;
}

/// One curve through all curves. Small ones that nothing reaches are left out: fairing fills their places.
std::optional<Curve> one_of(std::vector<Curve> curves, const Polygon& region, double w) {
  if (curves.empty()) return std::nullopt;
  std::stable_sort(curves.begin(), curves.end(),
                   [](const Curve& l, const Curve& r) { return l.length() > r.length(); });
  const double length = curves.front().length();
  if (curves.size() > 1) {
    if (std::optional<Curve> one = joined(curves, region, w)) return one;
  }
  double left_out = 0;
  for (std::size_t k = 1; k < curves.size(); ++k) left_out += curves[k].length();
  if (left_out > most_left_out * w + left_out_share * length) return std::nullopt;
  return std::move(curves.front());
}

}  // namespace

double bare_area(const Curve& curve, const Polygon& region, double bead_width) {
  const Lattice lattice = sample(region, bead_width / samples_per_width);
  LatticeOwners owners(lattice);
  owners.assign(curve.segments());
  const double reach = bare * bead_width;
  double sum = 0;
  for (std::size_t k = 0; k < lattice.size(); ++k) {
    if (owners.owner(k) >= 0 && owners.distance2(k) > reach * reach) sum += lattice.weight(k);
  }
  return sum;
}

std::optional<StripeCurve> stripe_curve(const Polygon& region, const DirectionField& field,
                                        const StripeOptions& options) {
  const double w = options.bead_width;
  if (field.empty() || stripe_nodes(region, w) > most_nodes) return std::nullopt;
  const BorderIndex border(region, w);
  std::vector<Curve> loops;
  {
    const Phase phase = find_phase(stripe_grid(region, border, field, w), border, w, options.may_continue);
    loops = zero_lines(phase, region, border, w);
  }
  // Rounded corners leave more room, but where loops come near to each other only sharp ones are safe.
  for (const int smoothing : {6, 1, 0}) {
    std::optional<Curve> one = one_of(merged(loops, region, field, w, smoothing, options.seed), region, w);
    if (!one || !simple_inside(*one, border)) continue;
    if (bare_area(*one, region, w) > most_bare * w * w + bare_share * area(region)) return std::nullopt;
    return StripeCurve{std::move(*one), std::move(loops)};
  }
  return std::nullopt;
}

}  // namespace unicursal::core
