// Nodes over a region, each with the direction across the strands that are asked for there. mm, radians.
#pragma once

#include <cstddef>
#include <vector>

#include "core/field/direction_field.hpp"
#include "core/geometry/border_index.hpp"
#include "core/geometry/polygon.hpp"

namespace unicursal::core {

struct StripeGrid {
  Vec2 origin{0, 0};  ///< position of column 0, row 0
  double pitch = 0;
  std::ptrdiff_t columns = 0, rows = 0;
  std::vector<std::ptrdiff_t> nodes;  ///< [row · columns + column]: index of the node; −1 far outside
  std::vector<Vec2> positions;        ///< per node
  std::vector<Vec2> normals;          ///< per node, unit vector across the strands; its sign means nothing

  std::size_t size() const { return positions.size(); }
  /// The node there; −1 if there is none.
  std::ptrdiff_t node(std::ptrdiff_t column, std::ptrdiff_t row) const {
    if (column < 0 || row < 0 || column >= columns || row >= rows) return -1;
    return nodes[static_cast<std::size_t>(row * columns + column)];
  }
};

/// Nodes in the region and one node around it. Directions are blurred over a bead width, so that noise and
/// jumps of the field do not tear strands.
StripeGrid stripe_grid(const Polygon& region, const BorderIndex& border, const DirectionField& field,
                       double bead_width);

/// The number of nodes that a region would get.
double stripe_nodes(const Polygon& region, double bead_width);

/// The nearest point of the border.
struct NearBorder {
  double distance = 0;  ///< mm, at most the reach
  Vec2 away{0, 0};      ///< unit vector from there to the point; zero if the border is out of reach
};
NearBorder near_border(const BorderIndex& border, const Vec2& point, double reach);

}  // namespace unicursal::core
