// The progress of a print in one line: "printing layer 38 of 100, 12 %, 1 h 05 min left (14:05), nozzle
// 205/205 °C, orange, 8 min ahead". Its fields have ranks: where the terminal is narrow, the least
// important ones become shorter, then go; none is cut.
#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>

#include "host/cli/terminal_look.hpp"
#include "host/engine/session_types.hpp"

namespace unicursal::host {

struct StatusLook {
  TerminalLook::Colours colours = TerminalLook::Colours::none;
  /// The colour of a mixture by the name that a status has for it; may be empty, and may not know it.
  std::function<std::optional<picture::Colour>(const std::string&)> colour_of;
  /// s that a dry run will still take; it has a pace of its own. Absent while unknown.
  std::optional<double> dry_left;
  bool dry = false;    ///< it is a dry run
  bool feeds = false;  ///< only filament moves: there are no layers
};

/// Returns the line, at most `width` columns wide unless its first word is wider. Apart from swatches, it is
/// free of control characters. `now`: for the time of day at which the print will be ready.
std::string status_line(const SessionStatus& status, const StatusLook& look, std::size_t width,
                        std::chrono::system_clock::time_point now);

/// "42 s", "4 min 20 s", "25 min", "1 h 05 min", "3 d 4 h"
std::string rough_duration(double seconds);
/// The local time of day, "14:05"; with the day of the week if that is not today's, "Tue 14:05".
std::string time_of_day(std::chrono::system_clock::time_point at, std::chrono::system_clock::time_point now);

}  // namespace unicursal::host
