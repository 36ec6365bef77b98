// What differs between firmwares: how a mixture is stored in a virtual tool, how a tool is selected, and
// limits. All other lines (G0/G1, G28, M104 …) are common to all dialects.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "firmware_gcode/print/mixture.hpp"

namespace unicursal::gcode {

/// The limits of a firmware.
struct Limits {
  std::size_t line_length = 95;    ///< characters of a line, including its number and checksum
  std::size_t virtual_tools = 16;  ///< T0 … T15
  std::size_t feeders = most_feeders;
  double extrusion = 200;          ///< mm of filament in one move; the firmware refuses more
  int mixture_decimals = 4;        ///< decimals of a share that the firmware keeps
  bool tool_change_stops = false;  ///< T waits until all motion has ended
  /// A share affects running moves at once, so that tools must be defined at standstill.
  bool shares_act_at_once = false;
};

class Dialect {
 public:
  virtual ~Dialect() = default;

  virtual const Limits& limits() const = 0;
  /// The name by which viewers of G-code files know the firmware.
  virtual std::string flavour() const = 0;
  /// The lines that store a mixture in a virtual tool. A reset of the firmware clears all tools.
  virtual std::vector<std::string> define_tool(std::size_t tool, const Mixture& mixture) const = 0;
  virtual std::string select_tool(std::size_t tool) const = 0;
  /// The mixture after rounding to the firmware's resolution.
  Mixture as_written(const Mixture& mixture) const { return mixture.quantised(limits().mixture_decimals); }
};

}  // namespace unicursal::gcode
