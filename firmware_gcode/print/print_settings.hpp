// What a print is to be like, apart from its geometry: speeds, heights, materials, skirt, fan and
// temperatures. The encoder and the estimates of time read it. mm, mm/s, mm³/s, °C.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/geometry/polygon.hpp"
#include "firmware_gcode/print/material.hpp"
#include "firmware_gcode/print/placed_layer.hpp"

namespace unicursal::gcode {

/// From this layer on the heaters keep other temperatures; what is absent stays.
struct LayerTemperature {
  std::size_t layer = 0;
  std::optional<double> nozzle, bed;  ///< °C
};

struct Fan {
  double percent = 0;
  std::size_t from = 0;  ///< layer that it starts at
};

/// Rings round the whole first layer.
struct Skirt {
  int loops = 0;
  double distance = 5;  ///< mm from the part's hull to the inner ring's border
};

/// What a job chooses. Defaults are those of a job that says nothing.
struct PrintChoices {
  double flow = 2;  ///< mm³/s, held constant; with `automatic_flow` only a first guess
  /// Hold the highest flow that the first layers' hairpins can sustain, and less in layers that need it
  /// (motion/held_flow.hpp).
  bool automatic_flow = false;
  std::optional<double> speed;   ///< mm/s, held constant instead of the flow
  double first_layer_speed = 1;  ///< fraction of the other layers' flow or speed, 0…1
  Skirt skirt;
  Fan fan;
  std::vector<LayerTemperature> temperatures;  ///< in ascending order of layers
  std::vector<Material> materials;             ///< of the zones, each once, in order of first use
  double change_before_border = 0.5;  ///< fraction of every change of mixture that falls before its border
  bool look_ahead = true;             ///< false, for comparison: switch where the border is
  Seam seam = Seam::hidden;
};

/// What follows from the part and its place on the bed.
struct PrintFrame {
  double layer_height = 0.2;  ///< mm, of all layers but the first
  double first_layer_height = 0.2;
  std::size_t layer_count = 0;
  std::vector<std::size_t> zone_materials;  ///< Bead::zone → index into PrintChoices::materials
  core::Box extent;                         ///< mm, of the part on the bed; the prime line keeps clear of it
  double part_height = 0;                   ///< mm, for the park position
};

/// Everything that the encoder has to know of a print beside its layers.
struct PrintSettings : PrintChoices, PrintFrame {
  std::size_t horizon = default_horizon;  ///< layers that the route is chosen over together
};

}  // namespace unicursal::gcode
