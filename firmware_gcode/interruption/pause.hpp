// A pause between two lines of a print: away from the part, and back to the same place. mm, mm³/s, °C.
//
// The chamber keeps its content, so that the colours continue where they were, except for the plastic that is
// squeezed out to replace what has dripped. Precondition of both functions: the state's position is known
// (the print has begun).
#pragma once

#include "core/geometry/polygon.hpp"
#include "firmware_gcode/interruption/modal_state.hpp"
#include "firmware_gcode/print/chunk.hpp"
#include "firmware_gcode/print/printer.hpp"

namespace unicursal::gcode {

struct Pause {
  ModalState state;   ///< state that the print's next line expects
  core::Box extent;   ///< of the part on the bed
  double flow = 2;    ///< mm³/s while plastic is squeezed out
  bool cool = false;  ///< lower the nozzle's temperature meanwhile; the bed stays warm to hold the part
};

/// Draws the filament back in equal shares, rises, and moves to a corner of the bed beside the part, or to
/// the back left corner if the part covers all corners. Ends when the printer stands still.
Chunk go_aside(const Printer& printer, const Pause& pause);

/// The line that lowers the nozzle's temperature during a long pause.
std::string cool_aside(const ModalState& state);

/// Heats again, squeezes out the volume of a transition beside the part if there is a place for it, returns,
/// and restores the state that the print's next line expects.
Chunk come_back(const Printer& printer, const Pause& pause);

}  // namespace unicursal::gcode
