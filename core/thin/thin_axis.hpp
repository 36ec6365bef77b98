// The medial axis of thin places, without its branches into corners, as a graph of chains. mm.
#pragma once

#include <cstddef>
#include <vector>

#include "core/geometry/region.hpp"
#include "core/thin/medial_axis.hpp"

namespace unicursal::core {

/// A way along the axis between two nodes that are not passed through: ends, junctions, mouths. Both are the
/// same node for a ring.
using AxisChain = std::vector<std::size_t>;

struct ThinAxis {
  MedialAxis nodes;            ///< only those in thin places are connected
  std::vector<char> used;      ///< whether the node belongs to a thin place and is wide enough to be laid
  std::vector<char> mouth;     ///< whether the axis goes on into a thick place there
  std::vector<double> corner;  ///< how far a corner without a branch of its own reaches out of the disc there

  std::size_t degree(std::size_t node) const { return nodes[node].next.size(); }
};

/// The axis of `region` inside `thin`, where the region is at least `least_width` wide. Branches that reach
/// hardly farther than the disc at their foot are left out.
ThinAxis thin_axis(const Polygon& region, const Region& thin, double bead_width, double least_width);

/// All chains, each once. Nodes that `breaks` marks are not passed through.
std::vector<AxisChain> chains(const ThinAxis& axis, const std::vector<char>& breaks);

/// A bounded face of the axis: the ring of nodes round it, counter-clockwise. Dead ends that reach into the
/// face are left out; faces that are not bounded by a single ring are not listed.
std::vector<AxisChain> faces(const ThinAxis& axis);

}  // namespace unicursal::core
