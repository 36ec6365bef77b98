// What a printer is and can do, found by asking it. Nothing that is sent moves, heats or keeps a change:
// M115, M503, M105, and forms of M163 and M85 that firmwares which know them carry out without effect (M163
// for a feeder that does not exist; M85 S0, which is how every firmware starts and every job ends). mm, mm/s,
// mm/s², °C, s.
#pragma once

#include <array>
#include <asio/any_io_executor.hpp>
#include <asio/awaitable.hpp>
#include <optional>
#include <string>
#include <vector>

#include "host/link/link.hpp"

namespace unicursal::host {

/// What M503 lists, as far as it matters here; x y z e.
struct MachineSettings {
  std::optional<std::array<double, 4>> steps_per_mm, max_speed, max_acceleration;
  std::optional<bool> volumetric;  ///< E is taken for mm³
};

/// From the lines of M503, of any Marlin: "echo:  M92 X80.00 Y80.00 Z400.00 E93.00".
MachineSettings settings_in(const std::vector<std::string>& lines);

struct Examination {
  gcode::Identity identity;
  gcode::Temperatures temperatures;
  std::optional<PrinterQueues> queues;  ///< with ADVANCED_OK
  bool reset_by_opening = false;        ///< the board has said that it starts
  bool mixes = false;                   ///< knows M163
  bool shuts_down = false;              ///< knows M85
  bool tells_settings = false;          ///< knows M503
  MachineSettings settings;
  double answer_seconds = 0;  ///< from a question to its answer, the median of several
};

/// Connects the link, which must not be connected yet. Throws LinkError.
asio::awaitable<Examination> examine(Link& link, asio::any_io_executor executor,
                                     std::shared_ptr<Clock> clock);

}  // namespace unicursal::host
