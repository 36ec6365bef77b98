// The sizes of everything on the strip, for one printer. mm, mm².
#pragma once

#include "firmware_gcode/print/printer.hpp"
#include "host/photo/marks.hpp"

namespace unicursal::host {

struct StripSizes {
  explicit StripSizes(const gcode::Printer& printer);

  double left, right, front, back;  ///< bounds of the usable area of the bed
  double layer_height;
  double line;       ///< width of the lines of ticks and numbers
  double thin, fat;  ///< cross-section of the strip's bead at its beginning, and the greatest, mm²
  double fat_width;
  double tick;  ///< distance of ticks, whole mm
  double gap;   ///< from the middle of the bead to where a tick begins
  double plain_tick, fifth_tick, tenth_tick;
  double digit_width, digit_height, digit_step;
  double number_gap;  ///< from the end of a tick to its number

  /// The room that a lane of the strip needs behind its middle, and in front of it.
  double behind() const { return gap + tenth_tick + number_gap + digit_height + line / 2; }
  double in_front() const { return gap + fifth_tick + line / 2; }
  double mark_radius() const { return MarkSizes(line).ring_outer; }
  /// The distance of lanes that fill the nozzle, and from a reference line to the next such lanes.
  double fill_pitch() const { return fat_width + line; }
  double reference_pitch() const { return 2 * gap + digit_height; }
};

}  // namespace unicursal::host
