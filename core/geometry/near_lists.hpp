// Which segments may be nearest to a sample of each block of a lattice's tile. mm.
#pragma once

#include <cstdint>
#include <vector>

#include "core/geometry/lattice.hpp"
#include "core/geometry/nearest_kernel.hpp"
#include "core/geometry/segment.hpp"
#include "core/geometry/segment_rows.hpp"

namespace unicursal::core {

struct NearLists {
  std::vector<std::int32_t> segments;  ///< around the tile, each once
  std::vector<std::uint32_t> start;    ///< per block of the tile, and one more, in `entries`
  std::vector<std::int32_t> entries;   ///< in `segments`
};

/// Makes a tile's lists anew. They are complete as long as no end of a segment has moved by more than `slack`
/// from where it is in `segments`, which `rows` holds. Precondition: there is at least one segment.
void make_near_lists(const Lattice& lattice, const Lattice::Tile& tile, const std::vector<Segment>& segments,
                     const SegmentRows& rows, double slack, NearLists& lists);

/// A segment in a tile's frame.
TileSegment in_tile(const Segment& segment, const Vec2& corner);

}  // namespace unicursal::core
