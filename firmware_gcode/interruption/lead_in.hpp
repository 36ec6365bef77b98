// How a printer that has lost its position and its heat is brought back to a place in a print that it has
// begun. mm, mm³.
//
// The nozzle stands on the part, perhaps frozen into it, at a height that only the print knows: z cannot be
// homed where the part is. So it heats first, rises by a relative move, is told how high it is then, and only
// homes x and y, whose way leads over the part. The user's own start lines are not run again: what they home,
// probe or prime would hit the part.
#pragma once

#include "core/geometry/polygon.hpp"
#include "firmware_gcode/interruption/modal_state.hpp"
#include "firmware_gcode/print/chunk.hpp"
#include "firmware_gcode/print/printer.hpp"

namespace unicursal::gcode {

struct LeadIn {
  ModalState state;   ///< to be in at the end
  double height = 0;  ///< mm, where the nozzle is now
  double flow = 2;    ///< mm³/s, of what is squeezed out
  core::Box extent;   ///< of the part on the bed
  double drawn = 0;   ///< mm of filament by which it is drawn back now, by the print or by what parked it
};

/// Heat, rise, home x and y, mixtures, two transitions of plastic into the air beside the part (a warning
/// tells when there is no such place), back to the place, down, and the state that its next line expects.
/// Retractions use the virtual tool of equal shares, if the print has one, so that every inlet gives way
/// alike. Precondition: x, y and z of the state are known, and it counts absolute positions.
Chunk lead_in(const Printer& printer, const LeadIn& to);

/// How far the nozzle rises first, mm: less where the bed's height ends.
double lead_in_rise(const Printer& printer, double height);

}  // namespace unicursal::gcode
