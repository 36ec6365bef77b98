// How large everything on the strip is, for one printer. mm, mm², mm³.
#pragma once

#include "firmware_gcode/print/printer.hpp"

namespace unicursal::host {

struct StripSizes {
  explicit StripSizes(const gcode::Printer& printer);

  double left, right, front, back;  ///< of the room on the bed
  double layer_height;
  double line;       ///< thickness of ticks and numbers
  double thin, fat;  ///< cross-section of the strip's bead at its beginning, and at most: mm²
  double fat_width;
  double tick;  ///< from tick to tick, whole mm
  double gap;   ///< from the bead's middle to where a tick begins
  double plain_tick, fifth_tick, tenth_tick;
  double digit_width, digit_height, digit_step;
  double number_gap;  ///< from a tick's end to its number

  /// What a lane of the strip takes behind its middle, and in front of it.
  double behind() const { return gap + tenth_tick + number_gap + digit_height + line / 2; }
  double in_front() const { return gap + fifth_tick + line / 2; }
  /// From lane to lane where the nozzle is filled, and from a line to compare with to the next such lanes.
  double fill_pitch() const { return fat_width + line; }
  double reference_pitch() const { return 2 * gap + digit_height; }
};

}  // namespace unicursal::host
