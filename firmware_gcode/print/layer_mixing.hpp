// What the mixing schedule makes of one layer. mm³.
#pragma once

#include <cstddef>
#include <limits>

namespace unicursal::gcode {

struct LayerMixing {
  std::size_t layer = 0;
  std::size_t changes = 0;      ///< of material that the path wants
  std::size_t switches = 0;     ///< that the printer is told
  std::size_t passed_over = 0;  ///< visits of a material too short to show
  double passed_over_volume = 0;
  double misplaced = 0;             ///< plastic that will lie in the wrong zone
  double wrong = 0;                 ///< where what arrives is nearer to another material of the layer
  std::size_t crossings = 0;        ///< of zones that take up changes, from one material to another
  std::size_t short_crossings = 0;  ///< that hold less than the mixing volume
  double shortest_crossing = std::numeric_limits<double>::infinity();

  /// Everything but the layer's index.
  LayerMixing& operator+=(const LayerMixing& more);
};

}  // namespace unicursal::gcode
