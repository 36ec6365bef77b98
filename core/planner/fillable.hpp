// Which parts of an island a bead can fill at all, and where its curve may start.
#pragma once

#include <vector>

#include "core/geometry/region.hpp"

namespace unicursal::core {

/// One closed curve's share of an island.
struct FillableRegion {
  Polygon region;     ///< what the curve fills: the island, or a piece of it between places too thin to pass
  Polygon domain;     ///< strictly inside `region`, without spikes: the cell graph is built here (paper's P)
  bool thin = false;  ///< much of it is narrower than two beads: there and back already fills it
};

struct Fillable {
  std::vector<FillableRegion> regions;
  double too_thin = 0;  ///< mm², of the island that is left out
};

/// `half_width` mm: half the least width that can be laid; `bead_width` mm. Spikes and necks narrower than
/// twice `half_width` are left out when they hold more than a corner's worth of area; the rounding of normal
/// corners stays in.
Fillable fillable(const Polygon& island, double bead_width, double half_width);

}  // namespace unicursal::core
