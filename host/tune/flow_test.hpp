// A print that shows how far each feeder's filament really goes: a numbered band of lines for each feeder,
// some 100 mm of its filament. How much the print asks of each feeder is known exactly, numbers and floor
// shares included, and a mark on each filament shows how much went in. The quotient is the feeder's flow
// factor (firmware_gcode/mixing/calibration.hpp). The print is made without flow factors, and without lines
// of the user's gcode.start and gcode.end that feed filament. mm of filament.
#pragma once

#include <string>
#include <vector>

#include "firmware_gcode/print/per_feeder.hpp"
#include "firmware_gcode/print/printer.hpp"
#include "host/tune/test_print.hpp"

namespace unicursal::host {

struct FlowTest {
  gcode::Printer printer;          ///< with which it is printed
  bool scripts_shortened = false;  ///< gcode.start or gcode.end
  TestPrint print;
  gcode::PerFeeder asked;  ///< of each feeder, mm
};

/// Throws core::DataError if it does not fit on the bed.
FlowTest make_flow_test(const gcode::Printer& printer);

/// Flow factors from what was asked and from what went in. Throws core::DataError if a factor is one that no
/// feeder can have.
gcode::PerFeeder flow_factors(const gcode::PerFeeder& asked, const gcode::PerFeeder& went_in);

/// The lines of a script that do not feed filament.
std::string without_feeding(const std::string& script);

}  // namespace unicursal::host
