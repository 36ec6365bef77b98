// The printer as a session knows it: what it has said, and what the lines that were handed to the link make
// of it. °C, per cent. No I/O: the session passes on every line that comes and goes. It belongs to the loop's
// thread.
#pragma once

#include <optional>
#include <string>

#include "firmware_gcode/interruption/modal_state.hpp"
#include "firmware_gcode/reply/reply.hpp"
#include "host/engine/printer_display.hpp"
#include "host/link/host_prompt.hpp"

namespace unicursal::host {

/// What a line from the printer means to the print.
struct Remark {
  enum class Kind {
    temperatures,  ///< it only reports temperatures
    unknown_m85,   ///< the firmware does not know M85: nothing cools it when this computer fails
    no_mixing,     ///< its feeders do not mix
    no_such_tool,  ///< it has fewer virtual tools
    unknown,       ///< it does not know a command; `text`: its words
    too_cold,      ///< it drives on without extruding, since the nozzle is too cold
    too_long,      ///< the same, since it takes the extrusion for a mistake
    action,        ///< `text`: what it asks for by "//action:"
    waits,         ///< it waits for a person, and reads nothing until that ends
    halted,        ///< it has stopped itself; only a reset helps
    other          ///< a person may want to see it; the session does nothing
  };
  Kind kind = Kind::other;
  std::string text;
};

struct PrinterView {
  /// Takes a line from the printer into account.
  Remark hear(const std::string& line);

  /// Takes a line of the print into account that is handed to the link.
  void run(const std::string& line);

  /// Whether the nozzle's position is known, so that it can be taken aside and back.
  bool knows_position() const;

  gcode::Temperatures temperatures;    ///< as the printer last reported them, °C
  bool mixes = true;                   ///< false once the printer has denied it
  bool has_tools = true;               ///< false once the printer has denied one
  std::optional<std::size_t> feeders;  ///< feeders that meet in the nozzle, if the printer has said so
  bool halted = false;                 ///< the firmware has said that it has stopped itself
  gcode::ModalState expected;  ///< its state after all lines of the print that were handed to the link
  /// Targets by the print's own lines, whatever the user has set since; absent before them. °C
  std::optional<double> job_nozzle, job_bed;
  HostPrompt prompt;               ///< what it asks a person
  PrinterDisplay display;          ///< what its own display shows
  std::string mixture;             ///< fed after those lines: name or shares; empty before the first
  bool may_wait_for_heat = false;  ///< it may be in a wait for heat, and read nothing until that ends
  bool must_not_move = false;      ///< it does not know where its nozzle is
  double speed_percent = 100;      ///< of the print's speed, as the user has set it
  double flow_percent = 100;       ///< of the print's extrusion, as the user has set it
};

}  // namespace unicursal::host
