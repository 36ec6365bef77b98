// The result of the mixing schedule for one layer. mm³.
#pragma once

#include <cstddef>
#include <limits>

namespace unicursal::gcode {

struct LayerMixing {
  std::size_t layer = 0;
  std::size_t changes = 0;      ///< of material along the path
  std::size_t switches = 0;     ///< of mixture that the printer carries out
  std::size_t passed_over = 0;  ///< visits to a material that are too short to show
  double passed_over_volume = 0;
  double misplaced = 0;             ///< volume in the wrong zone
  double wrong = 0;                 ///< volume whose mixture is nearer to another material of the layer
  std::size_t crossings = 0;        ///< of transition zones, from one material to another
  std::size_t short_crossings = 0;  ///< those shorter than the mixing volume
  double shortest_crossing = std::numeric_limits<double>::infinity();

  /// Adds everything except the layer's index.
  LayerMixing& operator+=(const LayerMixing& more);
};

}  // namespace unicursal::gcode
