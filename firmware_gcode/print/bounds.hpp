// The range of every number that a printer may have. A value outside is a typing error. All values inside
// fit the number format of the G-code (dialect/number.hpp). mm, mm/s, mm/s², mm³, mm³/s, °C.
#pragma once

namespace unicursal::gcode {

/// A range that includes both ends.
struct Bounds {
  double least, greatest;

  /// Returns false for NaN.
  constexpr bool hold(double value) const { return value >= least && value <= greatest; }
};

namespace bounds {

constexpr Bounds bed{1, 10000};
constexpr Bounds overtravel{0, 100};
constexpr Bounds nozzle{0.05, 10};
constexpr Bounds bead_width{0.01, 100};
constexpr Bounds speed{0.1, 10000};  ///< a slower feed rate would round to F0, which stops some firmwares
constexpr Bounds acceleration{1, 1e6};
constexpr Bounds filament_diameter{0.5, 10};
constexpr Bounds flow{0.001, 10000};
constexpr Bounds retraction_length{0, 100};
constexpr Bounds nozzle_temperature{0, 500};
constexpr Bounds bed_temperature{0, 200};
constexpr Bounds jerk{0.01, 1000};
constexpr Bounds junction_deviation{0, 1};
constexpr Bounds z_hop{0, 20};
constexpr Bounds extruder_steps{1, 100000};
constexpr Bounds flow_factor{0.5, 2};
constexpr Bounds transition{0, 10000};  ///< dead volume and mixing volume

}  // namespace bounds
}  // namespace unicursal::gcode
