// The numbers and switches in which firmwares of one family differ. The differences between families are in
// sim/firmware/firmware.hpp (Marlin), sim/firmware/repetier.hpp and sim/firmware/reprapfirmware.hpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace unicursal::sim {

struct Personality {
  enum class Family { marlin, repetier, reprapfirmware };

  std::string_view name;
  Family family = Family::marlin;
  bool advanced_ok = false;          ///< Whether an ok reads "ok N2 P14 B3".
  std::size_t most_feeders = 8;      ///< That a build can drive.
  bool direct_mixing = true;         ///< Whether it knows M165.
  std::int32_t mix_scale = 32768;    ///< Factor of the largest share of a mixture.
  int virtual_tools = 16;            ///< T0 … T15
  bool emergency_parser = false;     ///< Whether M108, M112, M410 and M876 act as soon as they arrive.
  bool host_prompts = false;         ///< Whether it asks a person through the host.
  bool homes_first = false;          ///< Whether it refuses moves of an axis that was not homed.
  double homing_clearance = 0;       ///< z that the nozzle is raised to before x or y is homed alone, mm.
  bool capabilities = true;          ///< Whether M115 lists what it can do, and M155 exists.
  bool progress = false;             ///< Whether it knows M73.
  std::size_t longest_text = 63;     ///< Characters of M117 that are kept; a display may show fewer.
  std::size_t queue_size = 4;        ///< Commands in the queue, the running one included.
  double cold = 170;                 ///< °C of the nozzle below which nothing is extruded.
  double step_rate = 0;              ///< Limit of each axis, steps/s; 0 = none.
  double boot_seconds = 0.5;         ///< From reset to the first message; input meanwhile is lost.
  bool resets_on_open = false;       ///< Whether DTR resets the board.
  std::vector<std::string> chatter;  ///< Messages after the boot.
};

/// Returns the personality of this name: marlin, marlin-8bit, marlin-advanced-ok, marlin-host,
/// marlin-few-tools, marlin-plain, repetier, repetier-0.92 or reprapfirmware.
/// Throws std::invalid_argument, whose message lists them.
const Personality& personality(std::string_view name);

/// The names of all.
std::vector<std::string> personality_names();

}  // namespace unicursal::sim
