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
  throw ModelError("", key, fmt::format("{} mm is no {}", value, key),
                   fmt::format("give it in mm, say {}", example));
}

LayerStack stack(double count, double layer_height) {
  if (count > most_layers) {
    throw ModelError("", "layer_height", fmt::format("{} mm makes more than a million layers", layer_height),
                     "give it in mm, say 0.2");
  }
  return {static_cast<std::size_t>(std::max(1.0, count)), layer_height};
}

}  // namespace

Layer LayerStack::layer(std::size_t index) const {
  Layer layer;
  layer.index = index;
  layer.z = (double(index) + 0.5) * thickness;
  layer.top = double(index + 1) * thickness;
  layer.height = thickness;
  return layer;
}

LayerStack layers_of_drawing(double height, double layer_height, Warnings& warnings) {
  require_positive(layer_height, "layer_height", "0.2");
  require_positive(height, "height", "1.0");
  const double exact = height / layer_height;
  const LayerStack result = stack(std::round(exact), layer_height);
  constexpr double tolerance = 0.01;  // of a layer
  if (std::abs(exact - double(result.count)) > tolerance) {
    warnings.add(fmt::format(
        "a height of {:.6g} mm is no multiple of the layer height {:.6g} mm; {} layers make {:.6g} mm",
        height, layer_height, result.count, result.height()));
  }
  return result;
}

LayerStack layers_of_mesh(double height, double layer_height) {
  require_positive(layer_height, "layer_height", "0.2");
  constexpr double noise = 1e-6;  // of a layer: mid-heights this near the top do not count
  return stack(std::ceil(height / layer_height - 0.5 - noise), layer_height);
}

}  // namespace unicursal::core
