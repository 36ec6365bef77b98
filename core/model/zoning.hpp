// Turns painted shapes into islands whose zones cover them without overlap.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/geometry/region.hpp"
#include "core/model/part.hpp"

namespace unicursal::core {

/// mm: shapes closer than this are joined, and uncovered strips narrower than this go to a neighbouring zone.
inline constexpr double weld_width = 0.01;
/// mm²: pieces and holes smaller than this are rounding, not shape.
inline constexpr double speck_area = weld_width * weld_width;

/// A shape and the zone that claims it, if any.
struct Painted {
  Region region;
  std::optional<std::size_t> zone;
  std::string label;  ///< how messages name the shape
};

/// A piece of the part, wider than a sliver, that belongs to no zone.
struct Unclaimed {
  std::string label;
  Vec2 place{0, 0};  ///< a point inside or near it
  double area = 0;   ///< mm², of this piece
};

struct Zoning {
  std::vector<Island> islands;       ///< largest first
  std::vector<Unclaimed> unclaimed;  ///< largest first; not part of the islands
};

/// Later shapes cover earlier ones, and the part is the union of all shapes. The zone regions of every island
/// add up to its outline. Borders of zones that nearly meet are made to meet; they lie within half of
/// `weld_width` of where they were drawn. Outlines leave what was drawn by no more than 1e-5 mm, except where
/// a gap is closed.
Zoning zoned(const std::vector<Painted>& shapes);

}  // namespace unicursal::core
