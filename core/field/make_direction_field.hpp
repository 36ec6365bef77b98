// What an island's zones ask of the curve's direction, as one field (paper §3.1).
//
//   const ZoneDirections files = read_zone_directions(part.zones());  // once per part: finds bad files early
//   const DirectionField field = make_direction_field(island, part.zones(), files, layer.z, 0.25);
//
// none, isotropic, anisotropic: nothing asked. angle: that angle. parallel, orthogonal: the run of the
// island's whole border, or, with `along_zone_border`, of the border of the zone's pieces (which holds the
// zone's share of the island's border), extended inside. field: the samples of the file.
#pragma once

#include <memory>
#include <vector>

#include "core/field/direction_field.hpp"
#include "core/field/scattered_directions.hpp"
#include "core/model/part.hpp"

namespace unicursal::core {

/// Per zone the samples that its pattern names; null for other patterns. Zones of one file share them.
using ZoneDirections = std::vector<std::shared_ptr<const ScatteredDirections>>;

/// Throws what `read_directions` throws.
ZoneDirections read_zone_directions(const std::vector<Zone>& zones);

/// `pitch` mm is the side of a grid square; half a bead width or less shows every fold. `z` mm, the height
/// of the cut, matters for samples in space only. Deterministic; never throws for a valid island.
DirectionField make_direction_field(const Island& island, const std::vector<Zone>& zones,
                                    const ZoneDirections& files, double z, double pitch);

/// For a single island, at z = 0: reads the files, too. Throws what `read_directions` throws.
DirectionField make_direction_field(const Island& island, const std::vector<Zone>& zones, double pitch);

}  // namespace unicursal::core
