// Brings a printer that has lost its position and its heat back to a place in a print. mm, mm³.
//
// The nozzle stands on the part and may be frozen into it. Only the print knows its height: z cannot be homed
// above the part. So the printer heats first, receives its height (RepRapFirmware refuses to move an axis
// whose position it does not know), rises, and homes only x and y, whose way leads above the part. The user's
// own start lines are not run again, since their homing, probing or priming would hit the part.
#pragma once

#include "core/geometry/polygon.hpp"
#include "firmware_gcode/interruption/modal_state.hpp"
#include "firmware_gcode/print/chunk.hpp"
#include "firmware_gcode/print/printer.hpp"

namespace unicursal::gcode {

struct LeadIn {
  ModalState state;   ///< state at the end of the lead-in
  double height = 0;  ///< present height of the nozzle, mm
  double flow = 2;    ///< mm³/s while plastic is squeezed out
  core::Box extent;   ///< of the part on the bed
  double drawn = 0;   ///< present retraction, mm of filament
};

/// Heats, rises, homes x and y, defines the mixtures, squeezes two transitions of plastic out beside the part
/// (or warns if there is no place for it), returns to the place, lowers the nozzle, and restores the state
/// that the next line expects. Retractions use the virtual tool of equal shares if the print has one, so that
/// all inlets retract alike. Precondition: the state has absolute positions, and its x, y and z are known.
Chunk lead_in(const Printer& printer, const LeadIn& to);

}  // namespace unicursal::gcode
