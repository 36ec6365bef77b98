// What a printer has reported goes into a new profile, as far as it is stricter than the shipped frame.
#pragma once

#include <string>
#include <vector>

#include "firmware_gcode/print/printer.hpp"

#include "host/doctor/examine.hpp"
#include "host/job/profile_draft.hpp"

namespace unicursal::host {

struct FoundPrinter {
  Examination examination;
  unsigned baud = 0;
  std::string port;  ///< as the profile is to name it
};

/// `frame`: the printer of the draft's own text.
void note_reported(ProfileDraft& draft, const FoundPrinter& found, const gcode::Printer& frame);

/// A list of numbers, as TOML writes it.
std::string toml_list(const std::vector<double>& values);

}  // namespace unicursal::host
