// A print that is held between two of its lines: out of the way, and back to the very place. mm, mm³/s, °C.
//
// The chamber keeps what is in it, so that the colours go on where they were but for what is squeezed out to
// make up for what has dripped. Precondition of both: the state's position is known (a print that has begun).
#pragma once

#include "core/geometry/polygon.hpp"
#include "firmware_gcode/interruption/modal_state.hpp"
#include "firmware_gcode/print/chunk.hpp"
#include "firmware_gcode/print/printer.hpp"

namespace unicursal::gcode {

struct Pause {
  ModalState state;   ///< that the print's next line expects
  core::Box extent;   ///< of the part on the bed
  double flow = 2;    ///< mm³/s, of what is squeezed out
  bool cool = false;  ///< lower the nozzle's heat meanwhile; the bed stays warm, or the part would come off
};

/// Draws the filament back in equal shares, rises, and goes to a corner of the bed beside the part, or the
/// one at the back left where the part leaves none; ends when the printer stands still there.
Chunk go_aside(const Printer& printer, const Pause& pause);

/// For a pause that lasts: the nozzle's heat lowered while it stands aside.
std::string cool_aside(const ModalState& state);

/// Reheats if need be, squeezes out a transition's volume beside the part if there is a place for it,
/// returns, and leaves every state as the print's next line expects it.
Chunk come_back(const Printer& printer, const Pause& pause);

}  // namespace unicursal::gcode
