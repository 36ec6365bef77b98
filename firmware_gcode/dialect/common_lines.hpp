// Lines and comments that every dialect has in common and that several rooms need.
#pragma once

#include <string>
#include <vector>

#include "firmware_gcode/print/printer.hpp"

namespace unicursal::gcode {

/// These comments enclose the user's own lines.
inline constexpr const char* user_lines_begin = ";BEGIN of your own lines";
inline constexpr const char* user_lines_end = ";END of your own lines";

/// A comment that cannot become a command: control characters and bytes beyond ASCII are replaced.
std::string comment(const std::string& text);

/// Millimetres, absolute positions, relative extrusion. M83 follows G90, which would override it.
std::vector<std::string> modes();

/// Sets the steps of the extruder's motor if the profile has them.
std::vector<std::string> calibration(const Printer& printer);

/// M85: without a command for so many seconds, the firmware turns the heaters off by itself; 0: never.
std::string shut_down_after(int seconds);
/// Sets the inactivity shutdown of a print and restarts its clock; repeated while a print is paused.
std::string stay_watchful();

}  // namespace unicursal::gcode
