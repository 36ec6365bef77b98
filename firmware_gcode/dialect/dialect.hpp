// What differs between firmwares: how a mixture becomes a virtual tool, how a tool is chosen, and limits.
// Everything else the encoder writes (G0/G1, G28, M104 …) is common ground.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "firmware_gcode/print/mixture.hpp"

namespace unicursal::gcode {

/// What a firmware can take, as data.
struct Limits {
  std::size_t line_length = 95;    ///< characters kept of a line, its number and checksum included
  std::size_t virtual_tools = 16;  ///< T0 … T15
  double extrusion = 200;          ///< mm of filament in one move; more is refused by the firmware
  int mixture_decimals = 4;        ///< decimals of a share as it is kept
  bool tool_change_stops = false;  ///< whether T waits until all motion has ended
  /// Whether a share acts at once on moves that run, so that tools are defined while all stands still.
  bool shares_act_at_once = false;
};

class Dialect {
 public:
  virtual ~Dialect() = default;

  virtual const Limits& limits() const = 0;
  /// What viewers of G-code files call the firmware.
  virtual std::string flavour() const = 0;
  /// The lines that make a virtual tool of a mixture; nothing of it survives a reset of the firmware.
  virtual std::vector<std::string> define_tool(std::size_t tool, const Mixture& mixture) const = 0;
  virtual std::string select_tool(std::size_t tool) const = 0;
  /// The shares that the firmware keeps of a mixture once it has been written.
  Mixture as_written(const Mixture& mixture) const { return mixture.quantised(limits().mixture_decimals); }
};

}  // namespace unicursal::gcode
