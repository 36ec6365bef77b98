#include "core/planner/bare.hpp"

#include <algorithm>
#include <vector>

#include "core/geometry/lattice.hpp"
#include "core/geometry/lattice_owners.hpp"
#include "core/geometry/segment.hpp"
#include "core/geometry/segment_grid.hpp"
#include "core/thin/medial_axis.hpp"

namespace unicursal::core {
namespace {

// In bead widths.
constexpr double bare = 0.75;       ///< a point farther from the curve is bare
constexpr double bare_samples = 5;  ///< lattice squares per bead width
constexpr double axis_step = 0.3;   ///< between the nodes of the medial axis
constexpr double narrow = 2;        ///< half the width of places whose axis is looked at

}  // namespace

Bare look_for_bare(const IslandPlan& plan, const Polygon& island, double bead_width, double least_width) {
  std::vector<Segment> strands;
  for (const PlannedCurve& curve : plan.curves) {
    for (std::size_t k = 0; k < curve.path.size(); ++k)
      strands.push_back({curve.path.start(k), curve.path.end(k)});
  }
  const double w = bead_width, reach = bare * w;
  Bare result;
  if (strands.empty()) return {area(island), 0};
  const Lattice lattice =
      sample(island, std::max(w / bare_samples, bounds(island).size().maxCoeff() / 30000));
  LatticeOwners owners(lattice);
  owners.assign(strands);
  for (std::size_t k = 0; k < lattice.size(); ++k) {
    if (lattice.weight(k) > 0 && owners.owner(k) >= 0 && owners.distance2(k) > reach * reach)
      result.area += lattice.weight(k);
  }
  const SegmentGrid grid(strands, w);
  const Vec2 margin(reach, reach);
  const MedialAxis axis = medial_axis(island, axis_step * w);
  for (std::size_t n = 0; n < axis.size(); ++n) {
    if (axis[n].radius > narrow * w || 2 * axis[n].radius < least_width) continue;
    const Vec2& p = axis[n].position;
    bool near = false;
    grid.near({p - margin, p + margin}, [&](std::size_t k) {
      near = near || distance_to_segment(p, strands[k].a, strands[k].b) <= reach;
    });
    if (near) continue;
    for (const std::size_t next : axis[n].next) result.axis_length += (axis[next].position - p).norm() / 2;
  }
  return result;
}

}  // namespace unicursal::core
