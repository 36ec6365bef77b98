// How a height is cut into layers of equal thickness, but for the first, which may have its own. All lengths
// in mm above the part's underside.
#pragma once

#include <cstddef>

#include "core/model/part.hpp"
#include "core/text/wording.hpp"

namespace unicursal::core {

struct LayerStack {
  std::size_t count = 0;
  double thickness = 0;  ///< of all but the first
  double first = 0;      ///< thickness of that

  double height() const { return double(count) * thickness + raised(); }
  /// Without islands; cut at mid-height.
  Layer layer(std::size_t index) const;

  /// How much higher all lies than it would on a first layer like the others; exactly 0 if it is.
  double raised() const { return first - thickness; }
};

/// The nearest whole number of layers, at least one; warns when the height is off by more than 1 % of a
/// layer. Throws ModelError for a height or layer height that is not positive or gives more than a million
/// layers. A first layer height of 0 is that of the others.
LayerStack layers_of_drawing(double height, double layer_height, double first_layer_height,
                             Warnings& warnings);

/// As many layers as have their mid-height below the top, at least one: the last layer may end up to half a
/// layer above or below the mesh. Throws as above. Precondition: `height` is not negative.
LayerStack layers_of_mesh(double height, double layer_height, double first_layer_height);

}  // namespace unicursal::core
