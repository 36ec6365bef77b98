// What firmware_gcode has to know of a machine. mm, mm/s, mm/s², mm³, mm³/s, °C, s.
#pragma once

#include <array>
#include <string>

namespace unicursal::gcode {

struct Printer {
  std::string name;
  std::string firmware = "marlin";
  std::array<double, 3> bed{200, 200, 200};                 ///< x y z, origin at the front left
  double nozzle = 0.4;                                      ///< opening
  std::array<double, 2> bead_width_range{0.24, 1.0};        ///< what the nozzle can lay
  std::array<double, 3> max_speed{150, 150, 10};            ///< x y z
  std::array<double, 3> max_acceleration{1500, 1500, 100};  ///< x y z
  int feeders = 3;
  double filament_diameter = 1.75;
  double max_flow = 8;  ///< mm³/s, all feeders together
  double floor_share = 0.02;
  double retraction_length = 4;  ///< mm of filament, all feeders together
  double retraction_speed = 25;
  double nozzle_temperature = 210;
  double bed_temperature = 60;
  double dead_volume = 2.1;    ///< mm³ before a new mixture first shows
  double mixing_volume = 4.0;  ///< mm³ from the first trace to 95 %
  std::string start_gcode;     ///< extra lines after homing and heating, may be empty
  std::string end_gcode;       ///< extra lines before the motors go off, may be empty
};

}  // namespace unicursal::gcode
