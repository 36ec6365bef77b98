// Which parts of an island a bead can fill, and in which domain the curve is first laid out.
#pragma once

#include <vector>

#include "core/geometry/region.hpp"

namespace unicursal::core {

/// The part of an island that one closed curve fills.
struct FillableRegion {
  Polygon region;  ///< the island, or a piece of it between places too thin to pass
  Polygon domain;  ///< strictly inside `region`, without spikes: the cell graph is built here (the paper's P)
  bool thin = false;  ///< much of it is narrower than two beads: a run there and back already fills it
};

struct Fillable {
  std::vector<FillableRegion> regions;
  double too_thin = 0;  ///< part of the island that is left out, mm²
};

/// `half_width` mm: half the least width that can be laid; `bead_width` mm. Spikes and necks narrower than
/// twice `half_width` are left out if their area is larger than that of a corner; the rounding of normal
/// corners stays in.
Fillable fillable(const Polygon& island, double bead_width, double half_width);

}  // namespace unicursal::core
