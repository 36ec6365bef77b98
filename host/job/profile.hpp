// A printer's profile: the machine itself and the port it hangs on. Units as in printer.hpp; baud in bits/s.
#pragma once

#include <filesystem>
#include <string>

#include "firmware_gcode/print/printer.hpp"

namespace unicursal::host {

struct Profile {
  std::filesystem::path file;
  gcode::Printer printer;
  std::string port = "auto";  ///< "auto": the only serial port there is
  unsigned baud = 250000;
  unsigned receive_buffer = 128;  ///< bytes, of the board
};

/// Throws core::FileError or JobError.
Profile load_profile(const std::filesystem::path& file);

}  // namespace unicursal::host
