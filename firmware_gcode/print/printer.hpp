// What firmware_gcode needs to know about a machine. mm, mm/s, mm/s², mm³, mm³/s, °C, s.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>

#include "firmware_gcode/print/per_feeder.hpp"

namespace unicursal::gcode {

/// Limits of the firmware's planner besides the maximum speeds and accelerations. They decide how long a
/// print takes and how much flow its hairpins sustain. The defaults are Marlin's.
struct Motion {
  std::array<double, 3> jerk{10, 10, 0.3};  ///< mm/s by which x, y, z may jump in a corner
  double extruder_jerk = 5;
  double junction_deviation = 0;  ///< mm by which a corner may be cut; 0: the jerk rule applies
  double acceleration = 3000;     ///< along a move that extrudes
  double travel_acceleration = 3000;
  double retract_acceleration = 3000;
  double extruder_speed = 50;  ///< greatest, of the filament
  double extruder_acceleration = 10000;
};

struct Printer {
  std::string name;
  std::string firmware = "marlin";
  std::array<double, 3> bed{200, 200, 200};  ///< x y z, origin at the front left
  std::array<double, 2> overtravel{};        ///< how far left and in front of the bed the nozzle can go
  double nozzle = 0.4;                       ///< diameter of the opening
  std::array<double, 2> bead_width_range{0.24, 1.0};        ///< mm; least and greatest
  std::array<double, 3> max_speed{150, 150, 10};            ///< x y z
  std::array<double, 3> max_acceleration{1500, 1500, 100};  ///< x y z
  std::size_t feeders = usual_feeders;
  double filament_diameter = 1.75;
  double max_flow = 8;  ///< mm³/s, all feeders together
  double floor_share = 0.02;
  double retraction_length = 4;  ///< mm of filament, all feeders together
  double retraction_speed = 25;
  double z_hop = 0;  ///< lift of the nozzle during a travel
  /// Steps of an extruder's motor per mm of filament, sent to the firmware; absent: the firmware's own value.
  std::optional<double> extruder_steps;
  /// How far each feeder must turn to feed 1 mm, relative to the others (mixing/calibration.hpp).
  PerFeeder flow_factors = PerFeeder::all(usual_feeders, 1);
  double nozzle_temperature = 210;
  double bed_temperature = 60;
  double dead_volume = 2.1;    ///< mm³ that pass before the first trace of a new mixture
  double mixing_volume = 4.0;  ///< mm³ from the first trace to 95 %
  std::size_t tanks = 2;       ///< stirred tanks in series that model the chamber; more: sharper changes
  bool overshoot = true;       ///< changes of mixture are sped up (mixing/overshoot.hpp)
  /// Each feeder pushes fresh plastic out before a part (toolpath/prime_line.hpp). Profiles turn it on.
  bool purge_inlets = false;
  Motion motion;
  std::string start_gcode;  ///< extra lines after homing and heating, may be empty
  std::string end_gcode;    ///< extra lines before the motors go off, may be empty
};

}  // namespace unicursal::gcode
