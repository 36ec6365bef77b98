// The medial axis of a polygon: the points that are equally far from two places of the border, each with that
// distance (Blum 1967). It is read off the Voronoi diagram of the polygon's edges and corners, which
// the library Boost.Polygon (1.74) computes exactly up to rounding for integer coordinates. mm.
#pragma once

#include <cstddef>
#include <vector>

#include "core/geometry/polygon.hpp"

namespace unicursal::core {

struct AxisNode {
  Vec2 position{0, 0};
  double radius = 0;              ///< distance to the border
  std::vector<std::size_t> next;  ///< nodes to which a straight piece of the axis leads
};

/// A plane graph; its nodes in an order that depends on the polygon only.
using MedialAxis = std::vector<AxisNode>;

/// The whole axis inside the polygon, branches into convex corners included. Neighbouring nodes are at most
/// `step` mm apart.
MedialAxis medial_axis(const Polygon& polygon, double step);

}  // namespace unicursal::core
