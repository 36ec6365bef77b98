// Several parts, or copies of one, on one plate. They are printed together, layer by layer. Lengths in mm.
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

/// Places rectangles of these sizes in rows, at least `gap` apart, as compactly as rows allow. Returns the
/// lower left corner of each; nullopt if they do not fit on the bed so.
std::optional<std::vector<Vec2>> arranged(const std::vector<Vec2>& sizes, const Vec2& bed, double gap);

}  // namespace unicursal::core
