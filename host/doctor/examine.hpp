// Finds out a printer's firmware and abilities by asking it. The questions move nothing, heat nothing and
// change no setting: M115, M503, M105, T (the tool is then T0 again), and forms of M163 and M85 without
// effect (M163 for a feeder that does not exist; M85 S0, which is the default of every firmware and the end
// of every job). mm, mm/s, mm/s², °C, s.
#pragma once

#include <array>
#include <asio/any_io_executor.hpp>
#include <asio/awaitable.hpp>
#include <optional>
#include <string>
#include <vector>

#include "host/link/link.hpp"

namespace unicursal::host {

/// The settings of M503 that matter here; x y z e.
struct MachineSettings {
  std::optional<std::array<double, 4>> steps_per_mm, max_speed, max_acceleration;
  std::optional<bool> volumetric;  ///< Whether the firmware takes E as mm³.
};

/// Parses the lines of M503 of any Marlin: "echo:  M92 X80.00 Y80.00 Z400.00 E93.00".
MachineSettings settings_in(const std::vector<std::string>& lines);
/// Parses RepRapFirmware's answers to M92, M203 and M201 (GCodes2.cpp of 3.5.3): "Steps/mm: X: 80.000, …",
/// "Max speeds (mm/min): X: 9000.0, …", "Accelerations (mm/sec^2): X: 1500.0, …".
MachineSettings spoken_settings(const std::vector<std::string>& lines);

struct Examination {
  gcode::Identity identity;
  gcode::Temperatures temperatures;
  std::optional<PrinterQueues> queues;  ///< nullopt without ADVANCED_OK.
  bool reset_by_opening = false;        ///< Whether the board has said "start".
  bool mixes = false;                   ///< Whether its feeders mix.
  std::optional<std::size_t> feeders;   ///< How many meet in the tool, if it has said so.
  std::optional<unsigned> tools;        ///< Its virtual tools, up to 16; nullopt if it cannot be asked.
  bool shuts_down = false;              ///< Whether M85 makes it cool down by itself.
  bool tells_settings = false;          ///< Whether it reports its settings.
  MachineSettings settings;
  double answer_seconds = 0;  ///< Time from a question to its answer, the median of several.
};

/// Connects the link, which must not be connected yet, and asks the questions. Throws LinkError.
asio::awaitable<Examination> examine(Link& link, asio::any_io_executor executor,
                                     std::shared_ptr<Clock> clock);

/// The same on an open port, in a loop of its own. Throws LinkError.
Examination examine_port(int port, const LinkOptions& options);

}  // namespace unicursal::host
