// What a printer's own display shows of a print, as its firmware keeps it. Whether there is a display at all,
// and how much of the text fits on it, does not matter to a host.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace unicursal::sim {

struct PrinterScreen {
  std::string text;                    ///< M117; empty: the firmware's own text
  std::uint64_t texts = 0;             ///< times that a text was set
  std::optional<double> percent;       ///< M73 P
  std::optional<double> minutes_left;  ///< M73 R
};

}  // namespace unicursal::sim
