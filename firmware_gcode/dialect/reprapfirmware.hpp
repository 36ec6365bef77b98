// RepRapFirmware 2 and 3 with a mixing tool (sim/README.md, "RepRapFirmware"). Its tools are real ones: a T
// waits until all motion has ended and runs macros, so tool 0 prints everything and its mixture is rewritten
// at each change. M567 P0 E<share>:<share>… acts on the moves that are read after it, as a move takes its
// shares with it into the queue (GCodes.cpp of 3.5.3, LoadExtrusionAndFeedrateFromGCode); it does not wait.
// The shares are not normalised: E is multiplied by each of them, so they must add up to exactly one, and
// there must be as many as the tool has drives (M563 P0 D0:1:2). T0 P0 selects the tool without its macros. A
// Duet 2 drives 7 extruders, a Duet 3 Mini 8 (MaxExtruders in the Pins_*.h of 3.5.3).
#pragma once

#include "firmware_gcode/dialect/share_writing.hpp"

namespace unicursal::gcode {

class RepRapFirmware : public ShareWriting {
 public:
  const Limits& limits() const override;
  std::string flavour() const override { return "RepRap"; }
  std::vector<std::string> choose_extruder() const override { return {select_tool(0)}; }
  std::string select_tool(std::size_t) const override { return "T0 P0"; }
  std::string write_shares(const Mixture& mixture) const override;
};

}  // namespace unicursal::gcode
