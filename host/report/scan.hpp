// Regions on a grid of square pixels: the region that a pixel's middle lies in, and the distance to another
// region. mm; pixel (0, 0) is the lower left one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/geometry/polygon.hpp"

namespace unicursal::host {

struct PixelGrid {
  core::Vec2 origin{0, 0};  ///< lower left corner
  double pixel = 0;
  std::size_t columns = 0, rows = 0;

  std::size_t size() const { return columns * rows; }
  /// The middle of a pixel; pixels are counted row by row from the lowest.
  core::Vec2 middle(std::size_t index) const {
    const core::Vec2 place(static_cast<double>(index % columns) + 0.5,
                           static_cast<double>(index / columns) + 0.5);
    return origin + place * pixel;
  }
};

using RegionLabel = std::uint8_t;
inline constexpr RegionLabel outside_all = 255;

struct LabelledPolygon {
  core::Polygon polygon;
  RegionLabel label = 0;
};

/// Row by row; a pixel in several polygons gets the last one's label.
std::vector<RegionLabel> scan(const std::vector<LabelledPolygon>& polygons, const PixelGrid& grid);

/// For each labelled pixel, its distance in mm to the border of its region: from its middle to that of the
/// nearest pixel with another label, less half a pixel. Infinite if there is only one label; 0 outside.
std::vector<float> distance_to_other_label(const std::vector<RegionLabel>& labels, const PixelGrid& grid);

}  // namespace unicursal::host
