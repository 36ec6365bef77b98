#include "host/feeding/extrusion.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "firmware_gcode/dialect/common_lines.hpp"
#include "firmware_gcode/dialect/dialect_named.hpp"
#include "firmware_gcode/dialect/share_writing.hpp"
#include "firmware_gcode/mixing/calibration.hpp"
#include "firmware_gcode/toolpath/move_writer.hpp"

namespace unicursal::host {
namespace {

constexpr double part_of_max_flow = 0.5;
constexpr double piece_of_push = 20;  ///< mm of a line; the lines in the printer's queue cannot be taken back

void append(std::vector<std::string>& to, const std::vector<std::string>& lines) {
  to.insert(to.end(), lines.begin(), lines.end());
}

}  // namespace

std::vector<std::string> extrusion(double length, const gcode::Printer& printer) {
  const gcode::Dialect& dialect = gcode::dialect_named(printer.firmware);
  std::vector<std::string> lines = gcode::choose_extruder(dialect);
  append(lines, gcode::modes());
  append(lines, gcode::calibration(printer));
  const gcode::CalibratedMixture equal =
      gcode::calibrated(gcode::Mixture::equal(printer.feeders), printer.flow_factors, dialect);
  append(lines, dialect.define_tool(0, equal.written));
  const double area = std::numbers::pi / 4 * printer.filament_diameter * printer.filament_diameter;
  const double speed = std::min(
      {part_of_max_flow * printer.max_flow / area, printer.retraction_speed, printer.motion.extruder_speed});
  gcode::MoveWriter writer(printer, dialect);
  writer.define_tool(0, "all feeders", equal);
  gcode::Chunk chunk;
  writer.select_tool(chunk, 0);
  const double pieces = std::ceil(std::abs(length) / piece_of_push);
  for (double piece = 0; piece < pieces; ++piece) writer.filament(chunk, length / pieces, speed);
  for (const std::string& line : chunk.lines) {
    if (!line.starts_with(';')) lines.push_back(line.substr(0, line.find(';')));
  }
  return lines;
}

}  // namespace unicursal::host
