// A printer's profile: the machine and the port it is connected to. Units as in
// firmware_gcode/print/printer.hpp; baud in bits/s.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "firmware_gcode/print/printer.hpp"

namespace unicursal::host {

struct Profile {
  std::filesystem::path file;
  gcode::Printer printer;
  std::string port = "auto";  ///< "auto": the only serial port there is
  unsigned baud = 250000;
  std::vector<std::string> filaments;  ///< their names, one for each feeder; empty: unknown
  unsigned receive_buffer = 128;       ///< bytes, of the firmware
};

/// Throws core::FileError or JobError.
Profile load_profile(const std::filesystem::path& file);
/// A profile that has not been written to `file` yet. Throws JobError.
Profile profile_in(const std::string& text, const std::filesystem::path& file);

}  // namespace unicursal::host
