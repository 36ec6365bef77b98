// Lists, for each block of a lattice's tile, the segments that may be nearest to one of its samples. mm.
#pragma once

#include <cstdint>
#include <vector>

#include "core/geometry/lattice.hpp"
#include "core/geometry/nearest_kernel.hpp"
#include "core/geometry/segment.hpp"
#include "core/geometry/segment_rows.hpp"

namespace unicursal::core {

struct NearLists {
  std::vector<std::int32_t> segments;  ///< segments around the tile, each once
  std::vector<std::uint32_t> start;    ///< per block of the tile, where its entries begin; and the end
  std::vector<std::int32_t> entries;   ///< indices in `segments`
};

/// Makes the lists of a tile. They remain complete until an end of a segment has moved by more than `slack`
/// from its place in `segments`. `rows` holds the same segments. Precondition: there is at least one segment.
void make_near_lists(const Lattice& lattice, const Lattice::Tile& tile, const std::vector<Segment>& segments,
                     const SegmentRows& rows, double slack, NearLists& lists);

/// A segment relative to the corner of a tile.
TileSegment in_tile(const Segment& segment, const Vec2& corner);

}  // namespace unicursal::core
