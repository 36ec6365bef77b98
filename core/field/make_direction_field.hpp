// Makes one field from the directions that the zones of an island ask for (paper §3.1).
//
//   const ZoneDirections files = read_zone_directions(part.zones());  // once per part: finds bad files early
//   const DirectionField field = make_direction_field(island, part.zones(), files, layer.z, 0.25);
//
// none, isotropic, anisotropic: no direction is asked for. angle: that angle. parallel, orthogonal: along or
// across the whole border of the island, extended to the inside; with `along_zone_border` along or across the
// border of the zone's own pieces, which includes the zone's share of the island's border. field: the samples
// of the file.
#pragma once

#include <memory>
#include <vector>

#include "core/field/direction_field.hpp"
#include "core/field/scattered_directions.hpp"
#include "core/model/part.hpp"

namespace unicursal::core {

/// Per zone: the samples of the file that its pattern names; null for other patterns. Zones with the same
/// file share them.
using ZoneDirections = std::vector<std::shared_ptr<const ScatteredDirections>>;

/// Throws what read_directions() throws.
ZoneDirections read_zone_directions(const std::vector<Zone>& zones);

/// `pitch` mm is the side of a grid square; half a bead width or less resolves every fold. `z` mm is the
/// height of the cut; it matters only for samples in space. Deterministic; never throws for a valid island.
DirectionField make_direction_field(const Island& island, const std::vector<Zone>& zones,
                                    const ZoneDirections& files, double z, double pitch);

/// For a single island at z = 0; also reads the files. Throws what read_directions() throws.
DirectionField make_direction_field(const Island& island, const std::vector<Zone>& zones, double pitch);

}  // namespace unicursal::core
