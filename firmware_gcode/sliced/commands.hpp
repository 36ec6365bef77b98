// What becomes of a slicer's commands other than moves. A command that no table names is sent as it is.
//
// Sources: Marlin 2.1, its GcodeSuite; Repetier 1.0, its Commands; RepRapFirmware 3.4 (the Duet G-code
// dictionary); Prusa-Firmware 3.13 (M862, M701, M702).
#pragma once

#include <string_view>

#include "firmware_gcode/sliced/words.hpp"

namespace unicursal::gcode {

enum class CommandKind {
  pass,       ///< sent as it is
  mode,       ///< the reader takes it into account: G20, G90, M82 …
  heat,       ///< sets or waits for a temperature
  wait,       ///< waits for a person
  leave_out,  ///< means nothing to a mixing printer, or would disturb the line to it
  refuse,     ///< would break the print or the printer
  mixture,    ///< defines mixtures: M163, M164, M165, M567
  rate,       ///< a factor of speed or flow (rates.hpp)
  homes,      ///< leaves the place of the nozzle unknown
  unknown     ///< sent as it is, and mentioned
};

struct CommandUse {
  CommandKind kind = CommandKind::unknown;
  std::string_view why;  ///< for `refuse` and `leave_out`: a clause, "saves settings in the printer"; empty:
                         ///< not worth a word
  std::string_view remedy;  ///< for `refuse`
};

CommandUse use_of(const SlicedCommand& command);

}  // namespace unicursal::gcode
