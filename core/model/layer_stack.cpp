#include "core/model/layer_stack.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace unicursal::core {
namespace {

constexpr double most_layers = 1e6;

void require_positive(double value, const char* key, const char* example) {
  if (value > 0 && std::isfinite(value)) return;
  throw ModelError("", key, fmt::format("{} mm is not a valid {}", value, key),
                   fmt::format("give it in mm, for example {}", example));
}

/// `above`: the number of layers on top of the first one.
LayerStack stack(double above, double layer_height, double first) {
  if (above >= most_layers) {
    throw ModelError("", "layer_height", fmt::format("{} mm makes more than a million layers", layer_height),
                     "give it in mm, for example 0.2");
  }
  return {1 + static_cast<std::size_t>(std::max(0.0, above)), layer_height, first};
}

double first_or_like_others(double first_layer_height, double layer_height) {
  if (first_layer_height == 0) return layer_height;
  require_positive(first_layer_height, "first_layer_height", "0.3");
  return first_layer_height;
}

}  // namespace

Layer LayerStack::layer(std::size_t index) const {
  Layer layer;
  layer.index = index;
  layer.height = index == 0 ? first : thickness;
  layer.top = double(index + 1) * thickness + raised();
  layer.z = index == 0 ? first / 2 : (double(index) + 0.5) * thickness + raised();
  return layer;
}

LayerStack layers_of_drawing(double height, double layer_height, double first_layer_height,
                             Warnings& warnings) {
  require_positive(layer_height, "layer_height", "0.2");
  require_positive(height, "height", "1.0");
  const double first = first_or_like_others(first_layer_height, layer_height);
  const double above = (height - first) / layer_height;
  const LayerStack result = stack(std::round(above), layer_height, first);
  constexpr double tolerance = 0.01;  // of a layer
  if (std::abs(above - double(result.count - 1)) > tolerance) {
    warnings.add(fmt::format(
        "a height of {:.6g} mm is not a multiple of the layer height {:.6g} mm; {} layers make {:.6g} mm",
        height, layer_height, result.count, result.height()));
  }
  return result;
}

LayerStack layers_of_mesh(double height, double layer_height, double first_layer_height) {
  require_positive(layer_height, "layer_height", "0.2");
  constexpr double noise = 1e-6;  // of a layer: a mid-height this near to the top counts as above it
  const double first = first_or_like_others(first_layer_height, layer_height);
  return stack(std::ceil((height - first) / layer_height + 0.5 - noise) - 1, layer_height, first);
}

}  // namespace unicursal::core
