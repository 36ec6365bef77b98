// A printer's profile: the machine and the port it is connected to. Units as in
// firmware_gcode/print/printer.hpp; baud in bits/s.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "firmware_gcode/print/printer.hpp"
#include "host/job/filament.hpp"

namespace unicursal::host {

/// What of the head could strike a finished part while another is printed beside it, mm.
struct HeadClearance {
  double radius = 0;  ///< from the nozzle to the farthest of what is near its height: heater, fans, ducts
  double height = 0;  ///< from the nozzle's tip up to what reaches farther: rods, belts, the whole carriage
};

struct Profile {
  std::filesystem::path file;
  gcode::Printer printer;
  std::string port = "auto";  ///< "auto": the only serial port there is
  unsigned baud = 250000;
  std::optional<HeadClearance> clearance;  ///< absent: not measured
  std::optional<double> tube_length;       ///< mm from a feeder to the hot end; absent: not measured
  Filaments filaments = usual_filaments(gcode::Printer());
  unsigned receive_buffer = 128;  ///< bytes, of the firmware
  double hottest_nozzle = 300;    ///< °C that a user may ask for while nothing is printed
  double hottest_bed = 120;
  bool display = true;  ///< the printer's own display shows how far a print is
};

/// Throws core::FileError or JobError.
Profile load_profile(const std::filesystem::path& file);
/// A profile that has not been written to `file` yet. Throws JobError.
Profile profile_in(const std::string& text, const std::filesystem::path& file);

}  // namespace unicursal::host
