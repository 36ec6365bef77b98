// Several parts, or copies of one, on one plate: printed together, layer by layer, or one after the other.
// mm.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/model/part.hpp"

namespace unicursal::core {

struct PlateItem {
  std::shared_ptr<const Part> part;
  Vec2 offset{0, 0};  ///< from the part's frame to the plate's
};

/// Preconditions: at least one item; all have the same zones and layer heights; none overlap.
std::unique_ptr<const Part> plate_of(std::vector<PlateItem> items);

/// The same, but the items are printed one after the other: the layers of the first, then those of the
/// second, and so on. A layer that lies on the bed begins the next item. Items may have different layer
/// counts and overlap in nothing.
std::unique_ptr<const Part> plate_in_turn(std::vector<PlateItem> items);

/// Places rectangles of these sizes in rows, at least `gap` apart, as compactly as rows allow. Returns the
/// lower left corner of each; nullopt if they do not fit on the bed so.
std::optional<std::vector<Vec2>> arranged(const std::vector<Vec2>& sizes, const Vec2& bed, double gap);

}  // namespace unicursal::core
