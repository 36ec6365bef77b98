// The settings of a print: speeds, heights, materials, skirt, fan and temperatures. The encoder and the time
// estimates read them. mm, mm/s, mm³/s, °C.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/geometry/polygon.hpp"
#include "firmware_gcode/print/material.hpp"
#include "firmware_gcode/print/placed_layer.hpp"

namespace unicursal::gcode {

/// New heater targets from this layer on; an absent one stays as it was.
struct LayerTemperature {
  std::size_t layer = 0;
  std::optional<double> nozzle, bed;  ///< °C
};

struct Fan {
  double percent = 0;
  std::size_t from = 0;  ///< first layer with the fan on
};

/// Rings around the whole first layer.
struct Skirt {
  int loops = 0;
  double distance = 5;  ///< mm from the part's convex hull to the inner ring's edge
};

struct PrintSettings {
  double flow = 2;  ///< mm³/s, held constant; with `automatic_flow`, a first guess
  /// Use the highest flow that the hairpins of the first layers can sustain, and less in layers that cannot
  /// sustain it (motion/laying_speed.hpp, motion/held_flow.hpp).
  bool automatic_flow = false;
  std::optional<double> speed;   ///< mm/s; if present, held constant instead of the flow
  double first_layer_speed = 1;  ///< fraction of the other layers' flow or speed, 0…1
  double layer_height = 0.2;     ///< mm, of all layers except the first
  double first_layer_height = 0.2;
  std::size_t layer_count = 0;
  Skirt skirt;
  Fan fan;
  std::vector<LayerTemperature> temperatures;  ///< sorted by layer
  std::vector<Material> materials;
  std::vector<std::size_t> zone_materials;  ///< Bead::zone → index into materials
  core::Box extent;                         ///< of the part on the bed; the prime line avoids it
  double part_height = 0;                   ///< mm, for the park position
  double change_before_border = 0.5;  ///< fraction of each change of mixture that lies before its border
  bool look_ahead = true;             ///< false, for comparison: switch at the border
  Seam seam = Seam::hidden;
  std::size_t horizon = default_horizon;  ///< number of layers over which the route is optimised
};

}  // namespace unicursal::gcode
