// Divides a height into layers of equal thickness; the first layer may have a different one. All lengths in
// mm above the part's underside.
#pragma once

#include <cstddef>

#include "core/model/part.hpp"
#include "core/text/wording.hpp"

namespace unicursal::core {

struct LayerStack {
  std::size_t count = 0;
  double thickness = 0;  ///< of all layers but the first
  double first = 0;      ///< thickness of the first layer

  double height() const { return double(count) * thickness + raised(); }
  /// The layer without its islands; the cut is at mid-height.
  Layer layer(std::size_t index) const;

  /// Extra height due to the first layer (first − thickness); exactly 0 if they are equal.
  double raised() const { return first - thickness; }
};

/// Takes the nearest whole number of layers, at least one; warns if the height is off by more than 1 % of a
/// layer. A first layer height of 0 means that of the others. Throws ModelError if a height is not positive,
/// or for more than a million layers.
LayerStack layers_of_drawing(double height, double layer_height, double first_layer_height,
                             Warnings& warnings);

/// Takes as many layers as have their mid-height below the top, at least one. So the last layer ends up to
/// half a layer above or below the top of the mesh. Throws like layers_of_drawing(). Precondition: `height`
/// is not negative.
LayerStack layers_of_mesh(double height, double layer_height, double first_layer_height);

}  // namespace unicursal::core
