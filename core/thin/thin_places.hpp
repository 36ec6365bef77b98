// Which parts of a region are so thin that strands along their medial axis fill them better than a
// space-filling curve. mm.
#pragma once

#include "core/geometry/region.hpp"

namespace unicursal::core {

struct ThinPlaces {
  Region thin;   ///< walls, bars, teeth and tips; together with `thick` the region, except for rounding
  Region thick;  ///< the rest: a space-filling curve fills each piece
};

/// The places narrower than `width` mm. Corners of thick places, and pieces between thin places that are
/// hardly wider than these, belong to their neighbours.
ThinPlaces thin_places(const Polygon& region, double bead_width, double width);

}  // namespace unicursal::core
