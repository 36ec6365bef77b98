// The clock by which planning is kept ahead of the printer.
#pragma once

#include <functional>

namespace unicursal::host {

/// In virtual time the printer's clock stands still while this computer plans. Each planning thread then
/// keeps a clock of its own (timeline.hpp).
struct PlanningClock {
  std::function<double()> now;  ///< s of the printer's clock, callable from any thread; empty in virtual time
  double charge = 1;            ///< in virtual time: s of the printer's clock for one second of planning
};

}  // namespace unicursal::host
