// Which firmware the simulated printer runs, as far as firmwares of one family differ by a number or a
// switch. What the families do differently is in firmware.hpp (Marlin) and repetier.hpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace unicursal::sim {

struct Personality {
  enum class Family { marlin, repetier };

  std::string_view name;
  Family family = Family::marlin;
  bool advanced_ok = false;          ///< "ok N2 P14 B3"
  bool direct_mixing = true;         ///< knows M165
  std::int32_t mix_scale = 32768;    ///< factors of a mixture are integers relative to the largest
  std::size_t queue_size = 4;        ///< commands, the running one included
  double step_rate = 0;              ///< steps/s that the processor can give one axis; 0: any
  double boot_seconds = 0.5;         ///< from reset to the first word; what is sent meanwhile is lost
  bool resets_on_open = false;       ///< a reset hangs on DTR
  std::vector<std::string> chatter;  ///< what it says when it has booted
};

/// By what --personality calls it: marlin, marlin-8bit, marlin-advanced-ok, repetier.
/// Throws std::invalid_argument, which lists them.
const Personality& personality(std::string_view name);

}  // namespace unicursal::sim
